// Which parts of a curve-skeleton to keep.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <vector>

namespace marrow {

/// The size of every connected part, in the order of their first nodes: the length of its centre
/// lines from surface to surface, which is the sum of its edges and of the radii of its leaves (of
/// a single node, its diameter). So a ball, whose line is short, counts as long as it is wide.
std::vector<double> part_sizes(const CurveSkeleton& skeleton);

/// Every connected part as a skeleton of its own, in the order of their first nodes. Nodes and
/// edges keep their order.
std::vector<CurveSkeleton> parts_of(const CurveSkeleton& skeleton);

/// The part of the greatest size; of several, the first. Nodes and edges keep their order.
CurveSkeleton largest_part(const CurveSkeleton& skeleton);

/// The parts of at least `share` (0 to 1) of the greatest size. Nodes and edges keep their order.
CurveSkeleton large_parts(const CurveSkeleton& skeleton, double share);

}  // namespace marrow
