#include <marrow/silhouette.hpp>

#include "fill_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

constexpr double kSmallHole = 0.02;  // inscribed radius, in sides of the image

}  // namespace

BitImage draw_silhouette(const NormalizedShape& shape, const ViewPlane& plane, int resolution) {
  const SnappedPoints points = snap(shape, plane, resolution);
  auto [mask, large] = fill(points, shape.triangles, facing_of(shape), resolution);
  trace_thin(mask, points, shape.triangles, large, resolution);
  if (!shape.closed) fill_small_holes(mask, kSmallHole * resolution);
  return mask;
}

}  // namespace marrow
