// Normals at the corners of a triangle soup, for smooth shading.
#pragma once

#include <marrow/shape.hpp>

#include <array>
#include <span>
#include <vector>

namespace marrow {

using Point3f = std::array<float, 3>;

/// Not normalised; its length is twice the area of the triangle.
Point3f face_normal(std::span<const Point3f> points, const Triangle& triangle);

/// One unit normal per point, the area-weighted mean over the triangles around it. Points at the
/// same place share one, so that unwelded soups shade smoothly too; triangles are turned to agree
/// with those before them, so that orientation does not matter. Zero where there is none.
std::vector<Point3f> vertex_normals(std::span<const Point3f> points,
                                    std::span<const Triangle> triangles);

}  // namespace marrow
