// How far the neighbours of points are.
#pragma once

#include <span>
#include <vector>

#include "point_tree_detail.hpp"

namespace marrow {

/// For every point the distance to its `kNeighbour`-th nearest other point, or to the farthest
/// where there are fewer; 0 for a single point. Equal distances are no matter.
inline constexpr int kNeighbour = 8;
std::vector<float> neighbour_distances(std::span<const PointF> points);

}  // namespace marrow
