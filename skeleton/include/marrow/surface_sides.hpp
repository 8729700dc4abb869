// On which side of the surface a point lies, asked of lines along the three axes.
#pragma once

#include <marrow/normalization.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace marrow {

enum class Side : std::uint8_t {
  Unknown,  ///< the lines disagree, or run through holes of the surface and say nothing
  Inside,
  Outside,
};

struct PointSide {
  Side side = Side::Unknown;
  double clearance =
      0;  ///< least distance to the surface along the six half lines; 4 if none meets it
};

class SurfaceColumns;

/// Asks the surface of a shape. Exact integer arithmetic on a lattice of 2^-18; the order of
/// triangles and points is nothing.
class SurfaceSides {
 public:
  /// `shape` must outlive this.
  explicit SurfaceSides(const NormalizedShape& shape);
  ~SurfaceSides();
  SurfaceSides(const SurfaceSides&) = delete;
  SurfaceSides& operator=(const SurfaceSides&) = delete;

  const NormalizedShape& shape() const { return shape_; }

  /// For every point of the normalised frame, what the signed crossings of the surface with the
  /// lines through it say. On a line whose crossings cancel as a whole the point is outside when
  /// those before it cancel too; other lines run through a hole of the surface and have no say. The
  /// point is inside or outside when at least one line says so and none says otherwise. What was
  /// sorted for an answer is kept for the next.
  std::vector<PointSide> of(std::span<const Vec3> points);

 private:
  const NormalizedShape& shape_;
  std::unique_ptr<SurfaceColumns> columns_;
};

}  // namespace marrow
