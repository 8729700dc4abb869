#include <marrow/distance_transform.hpp>
#include <marrow/silhouette.hpp>

#include "fill_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

constexpr double kSmallHole = 0.02;  // inscribed radius, in sides of the image

}  // namespace

void fill_small_holes(BitImage& mask, double radius) {
  const int width = mask.width(), height = mask.height();
  const BitImage background = complement(mask);
  const DistanceMap depth = distance_transform(background);
  BitImage open = background;  // not yet visited
  std::vector<std::pair<int, int>> part;
  for (int y0 = 0; y0 < height; ++y0)
    for (int x0 = 0; x0 < width; ++x0) {
      if (!open(x0, y0)) continue;
      part.assign(1, {x0, y0});
      open.clear(x0, y0);
      bool enclosed = true;
      ChamferDistance deepest = 0;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto [x, y] = part[k];
        deepest = std::max(deepest, depth(x, y));
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!mask.contains(x + dx, y + dy))
            enclosed = false;
          else if (open(x + dx, y + dy)) {
            open.clear(x + dx, y + dy);
            part.push_back({x + dx, y + dy});
          }
        }
      }
      if (enclosed && pixels_of(deepest) < radius)
        for (const auto& [x, y] : part) mask.set(x, y);
    }
}

BitImage draw_silhouette(const NormalizedShape& shape, const ViewPlane& plane, int resolution) {
  const SnappedPoints points = snap(shape, plane, resolution);
  auto [mask, large] = fill(points, shape.triangles, facing_of(shape), resolution);
  trace_thin(mask, points, shape.triangles, large, resolution);
  if (!shape.closed) fill_small_holes(mask, kSmallHole * resolution);
  return mask;
}

}  // namespace marrow
