#include <marrow/point_silhouette.hpp>
#include <marrow/silhouette.hpp>

#include <algorithm>

#include "contour_silhouettes_detail.hpp"
#include "edge_neighbours_detail.hpp"
#include "fill_detail.hpp"
#include "mask_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kFewImages = 8;     // are drawn one by one
constexpr double kLongEdge = 2;           // pixels: from here on contours are faster than the fill
constexpr std::size_t kSample = 1 << 10;  // triangles

/// The mean of the longest edges of some triangles.
double mean_longest_edge(const NormalizedShape& shape) {
  const std::size_t step = shape.triangles.size() / kSample + 1;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < shape.triangles.size(); i += step, ++count) {
    const auto point = [&](std::size_t corner) {
      const std::uint32_t p = shape.triangles[i][corner];
      return Vec3{double{shape.x[p]}, double{shape.y[p]}, double{shape.z[p]}};
    };
    const Vec3 a = point(0), b = point(1), c = point(2);
    sum += std::max({length(b - a), length(c - b), length(a - c)});
  }
  return sum / count;
}

/// Edge neighbours where so many images are better drawn by contours; else none.
std::vector<Triangle> neighbours_for_contours(const NormalizedShape& shape, std::size_t images,
                                              int resolution) {
  if (!shape.oriented || images < kFewImages ||
      mean_longest_edge(shape) < kLongEdge * PixelGrid{resolution}.pixel())
    return {};
  return edge_neighbours(shape.triangles, shape.x.size());
}

}  // namespace

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

std::vector<BitImage> draw_silhouettes(const NormalizedShape& shape,
                                       std::span<const ViewPlane> planes, int resolution,
                                       const SurfaceScene* scene, const ForEach& for_each) {
  std::vector<Triangle> neighbours;
  if (scene == nullptr) neighbours = neighbours_for_contours(shape, planes.size(), resolution);
  if (!neighbours.empty()) return draw_by_contours(shape, neighbours, planes, resolution, for_each);
  std::vector<BitImage> masks(planes.size());
  for_each(planes.size(),
           [&](std::size_t i) { masks[i] = draw_silhouette(shape, planes[i], resolution, scene); });
  return masks;
}

}  // namespace marrow
