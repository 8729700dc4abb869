#include <marrow/silhouette.hpp>

#include "fill_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

constexpr double kSmallHole = 0.02;  // inscribed radius, in sides of the image

}  // namespace

BitImage draw_silhouette(const NormalizedShape& shape, const ViewPlane& plane, int resolution,
                         const SurfaceScene* scene) {
  const SnappedPoints points = snap(shape, plane, resolution);
  BitImage mask;
  if (scene != nullptr) {
    mask = fill_by_rays(*scene, plane, resolution);
    trace_thin_triangles(mask, points, shape.triangles, resolution);
  } else {
    TriangleFill filled = fill(points, shape.triangles, facing_of(shape), resolution);
    mask = std::move(filled.mask);
    trace_thin(mask, points, shape.triangles, filled.large, resolution);
  }
  if (!shape.closed) fill_small_holes(mask, kSmallHole * resolution);
  return mask;
}

}  // namespace marrow
