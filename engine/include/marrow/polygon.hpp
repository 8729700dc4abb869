// Cutting polygons into triangles.
#pragma once

#include <marrow/shape.hpp>
#include <marrow/vec.hpp>

#include <span>
#include <vector>

namespace marrow {

/// Indices below the number of corners mean corners, in the order in which they were given; the
/// next ones mean `extra_points`, where edges of the polygon cross each other.
struct PolygonCut {
  std::vector<Triangle> triangles;
  std::vector<Vec3> extra_points;
};

/// Triangles that cover what the polygon covers, seen along its mean normal, and nothing else: its
/// inside is where its winding number is not zero. It may be concave, not quite flat, touch itself
/// (a hole joined to the rim by a doubled edge stays a hole) and cross itself. Coordinates are
/// finite, of any magnitude; corners closer than 1e-9 of the polygon's size are one.
/// Takes O(n log n) for n corners, unless the polygon touches or crosses itself. Of a polygon
/// without an inside the edges are left, as triangles of no width. One that crosses itself more
/// than some 100,000 times, or has edges so close that rounding makes them cross again and again,
/// is cut into a fan, which then may cover more.
PolygonCut cut_polygon(std::span<const Vec3> corners);

}  // namespace marrow
