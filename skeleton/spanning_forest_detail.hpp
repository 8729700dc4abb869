// A tree through every part of a curve-skeleton, for formats that know nothing else.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace marrow::skeleton_detail {

inline constexpr NodeId kNoParent = std::numeric_limits<NodeId>::max();

/// In depth-first order: a parent before its children, a part after the other.
struct SpanningForest {
  std::vector<NodeId> order;       ///< nodes as they are visited
  std::vector<NodeId> parent;      ///< of every node; kNoParent: a root
  std::vector<std::uint64_t> row;  ///< of every node in the order, from 1
};

/// Every part from its thickest node on, the first of equals; neighbours in the order of their ids,
/// so that a file that is read back is written the same.
SpanningForest spanning_forest(const CurveSkeleton& skeleton);

}  // namespace marrow::skeleton_detail
