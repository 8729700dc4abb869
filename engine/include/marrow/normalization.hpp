// The shape's own frame (section 4.2, last paragraphs): principal axes, bounding sphere.
#pragma once

#include <marrow/shape.hpp>
#include <marrow/vec.hpp>
#include <marrow/volume.hpp>

#include <span>
#include <vector>

namespace marrow {

/// Maps input units to the normalised frame, where the shape's box is centred on the origin, its
/// principal axes are y (greatest), x, z (least), and its bounding sphere has radius 1; that of a
/// point cloud has room for a ball of its spacing around every point.
struct Normalization {
  double prescale = 1;  ///< a power of two, applied first so that no product can overflow
  Vec3 center;          ///< centre of the box, prescaled
  Frame axes;           ///< principal axes, right-handed
  double radius = 1;    ///< of the bounding sphere about the centre, prescaled

  Vec3 to_normalized(const Vec3& p) const { return to_frame(axes, p * prescale - center) / radius; }
  Vec3 to_input(const Vec3& q) const { return (from_frame(axes, q) * radius + center) / prescale; }
  double length_to_input(double length) const { return length * radius / prescale; }

  friend bool operator==(const Normalization&, const Normalization&) = default;
};

/// The principal frame of the surface: exact second moments of the triangles, weighted by area, so
/// that re-meshing a part does not move it. The sign of an axis makes the third moment along it
/// positive; where that vanishes, its greatest component in input coordinates is positive. Where
/// two or three moments coincide, the input axes decide. Sums are integers: the order of points and
/// triangles does not matter. Unused points never count. Of a point cloud the points themselves are
/// taken, all with the same weight, repeated ones once; `spacing` is what point_spacing() gives.
/// Throws Error: Empty, when there are no points or all that count coincide; Malformed, when one
/// that counts is not finite, or a triangle has a corner that is no point.
Normalization normalize(const Shape& shape, std::span<const double> spacing);
Normalization normalize(const Shape& shape);  ///< The same, with the shape's own spacing.

/// The same of the foreground of a volume, from the exact moments of its voxels as solid boxes.
/// Throws Error: Empty, when there is none.
Normalization normalize(const Volume& volume);

/// A shape in the normalised frame, as the silhouette kernels want it; only points that count.
struct NormalizedShape {
  std::vector<float> x, y, z;  ///< |.| <= 1
  std::vector<Triangle> triangles;
  std::vector<float> spacing;  ///< of a point cloud: radius of the disc around every point
  Vec3 low, high;              ///< bounding box
  bool closed = false;    ///< every edge has an even number of triangles, points welded by position
  bool oriented = false;  ///< closed, and every edge is run through as often in either direction

  bool is_point_cloud() const { return triangles.empty(); }
};

/// Half of the points of a cloud have no greater spacing.
double median_spacing(const NormalizedShape& cloud);

NormalizedShape apply(const Normalization& normalization, const Shape& shape,
                      std::span<const double> spacing);
NormalizedShape apply(const Normalization& normalization, const Shape& shape);

}  // namespace marrow
