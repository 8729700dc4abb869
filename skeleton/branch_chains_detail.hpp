// Branches whose inner nodes change, while the graph stays what it is.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <vector>

namespace marrow::skeleton_detail {

/// How many nodes every branch must have between its ends so that its edges stay apart from each
/// other and from those of other branches.
std::vector<std::size_t> least_inner_nodes(const std::vector<Branch>& branches);

/// Edges between the nodes that follow each other in the chains, sorted.
std::vector<CurveSkeleton::Edge> edges_along(const std::vector<Branch>& chains);

/// A node on the line from a to b; `t` from 0 to 1.
CurveSkeleton::Node between(const CurveSkeleton::Node& a, const CurveSkeleton::Node& b, double t);

}  // namespace marrow::skeleton_detail
