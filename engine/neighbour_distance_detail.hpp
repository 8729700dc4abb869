// How far the neighbours of points are.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace marrow {

using PointF = std::array<float, 3>;

/// For every point the distance to its `kNeighbour`-th nearest other point, or to the farthest
/// where there are fewer; 0 for a single point. Equal distances are no matter.
inline constexpr int kNeighbour = 8;
std::vector<float> neighbour_distances(std::span<const PointF> points);

}  // namespace marrow
