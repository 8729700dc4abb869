// Which points of a shape count.
#pragma once

#include <marrow/shape.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// For every point, 1 if a triangle uses it, else 0.
inline std::vector<std::uint8_t> used_points(const Shape& shape) {
  std::vector<std::uint8_t> used(shape.points.size(), 0);
  for (const Triangle& t : shape.triangles)
    for (const std::uint32_t i : t) used[i] = 1;
  return used;
}

/// For every point of a cloud, 1 if it has some spacing, else 0.
inline std::vector<std::uint8_t> used_points(std::span<const double> spacing) {
  std::vector<std::uint8_t> used(spacing.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = spacing[i] > 0;
  return used;
}

/// A point cloud as a shape with triangles: every point of some spacing is one whose corners
/// coincide. Other points do not count.
inline Shape with_point_triangles(const Shape& cloud, std::span<const double> spacing) {
  Shape shape{cloud.points, {}};
  for (std::uint32_t i = 0; i < spacing.size(); ++i)
    if (spacing[i] > 0) shape.triangles.push_back({i, i, i});
  return shape;
}

/// Calls visit(point) for every used point, in order.
template <class Visit>
void for_used_points(const Shape& shape, const std::vector<std::uint8_t>& used, Visit visit) {
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) visit(shape.points[i]);
}

}  // namespace marrow
