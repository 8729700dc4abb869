// Which points of a shape count.
#pragma once

#include <marrow/shape.hpp>

#include <cstdint>
#include <vector>

namespace marrow {

/// For every point, 1 if a triangle uses it, else 0.
inline std::vector<std::uint8_t> used_points(const Shape& shape) {
  std::vector<std::uint8_t> used(shape.points.size(), 0);
  for (const Triangle& t : shape.triangles)
    for (const std::uint32_t i : t) used[i] = 1;
  return used;
}

/// Calls visit(point) for every used point, in order.
template <class Visit>
void for_used_points(const Shape& shape, const std::vector<std::uint8_t>& used, Visit visit) {
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) visit(shape.points[i]);
}

}  // namespace marrow
