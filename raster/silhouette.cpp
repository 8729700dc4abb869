#include <marrow/point_silhouette.hpp>
#include <marrow/silhouette.hpp>

#include "fill_detail.hpp"
#include "mask_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

BitImage draw_silhouette(const NormalizedShape& shape, const ViewPlane& plane, int resolution,
                         const SurfaceScene* scene) {
  if (shape.is_point_cloud()) return draw_point_silhouette(shape, plane, resolution);
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
