// What a shape is: points, and triangles between them.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace marrow {

/// Three indices into the points of a shape, in either orientation.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle soup in the units of its file. Nothing is asked of it: it may be open, unoriented,
/// non-manifold, in many parts, and may hold points that no triangle uses (they never count).
/// Coordinates are finite, of any magnitude; indices are in range.
struct Shape {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  friend bool operator==(const Shape&, const Shape&) = default;
};

}  // namespace marrow
