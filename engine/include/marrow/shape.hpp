// What a shape is: points, and triangles between them.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace marrow {

/// Three indices into the points of a shape, in either orientation.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle soup or a point cloud in the units of its file. Nothing is asked of it: it may be
/// open, unoriented, non-manifold, in many parts, and may hold points that no triangle uses (they
/// never count). A shape without triangles is a point cloud, of which all points count. Coordinates
/// are finite, of any magnitude; indices are in range.
struct Shape {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  bool is_point_cloud() const { return triangles.empty(); }

  friend bool operator==(const Shape&, const Shape&) = default;
};

}  // namespace marrow
