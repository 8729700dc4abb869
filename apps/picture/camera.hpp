// Where the picture looks from: a well-framed pose of the shape, and four parallel projections.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/normalization.hpp>
#include <marrow/shape.hpp>

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "picture/image.hpp"

namespace marrow {

/// The points that count: those that triangles use; all of them when there are no triangles.
std::vector<Vec3> drawn_points(const Shape& shape);

/// Maps input units to the pose of the picture: x to the right, y up, z to the viewer of the front
/// view, the box centred on the origin, the longest half-diagonal 1. The front view looks along the
/// shortest side of the shape's box, so that it shows the most. The box is that of the input axes
/// where it fits the shape about as well as that of the principal axes (then a standing figure
/// stands straight), else that of the principal axes. y (or z, for the many files with z up) of the
/// input points up rather than down. Without points the skeleton is posed; empty is the identity.
Normalization pose_of(const Shape& shape, const CurveSkeleton& skeleton);

/// `p` in the pose, moved to within 1000 of the origin: a skeleton that belongs to another shape
/// may be anywhere, beyond floats even.
Vec3 place(const Normalization& pose, const Vec3& p);

/// A parallel projection onto pixels.
struct View {
  std::string_view name;
  Vec3 right, up, toward;             ///< orthonormal, in the pose
  Rect cell;                          ///< where in the picture
  double scale = 1;                   ///< pixels per unit of the pose
  double origin_x = 0, origin_y = 0;  ///< pixel coordinates of the origin of the pose

  /// Pixel coordinates and, as z, nearness to the viewer in pixels.
  Vec3 project(const Vec3& p) const {
    return {origin_x + scale * dot(right, p), origin_y - scale * dot(up, p),
            scale * dot(toward, p)};
  }
  /// The point of the plane through the origin of the pose that pixel coordinates (x, y) show.
  Vec3 unproject(double x, double y) const {
    return right * ((x - origin_x) / scale) + up * ((origin_y - y) / scale);
  }
};

enum class ViewChoice { Front, Side, Top, ThreeQuarter, All };

/// Views of `points` (in the pose) in `area`. All four are laid out two by two or, where that shows
/// the front clearly larger, side by side, each scaled to its cell; one alone takes the area.
std::vector<View> views_of(std::span<const Vec3> points, const Rect& area, ViewChoice choice);

}  // namespace marrow
