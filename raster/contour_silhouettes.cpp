#include <algorithm>

#include "contour_silhouettes_detail.hpp"
#include "contour_views_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

/// Up to kMostViews silhouettes of a shape with edge neighbours.
class ContourSilhouettes {
 public:
  ContourSilhouettes(const NormalizedShape& shape, std::span<const Triangle> neighbours,
                     std::span<const ViewPlane> planes, int resolution, const ForEach& for_each)
      : shape_(shape),
        planes_(planes),
        resolution_(resolution),
        views_(shape, neighbours, planes, resolution, for_each) {}

  void draw(std::span<BitImage> masks, const ForEach& for_each) {
    std::vector<BitImage> far(masks.size());
    for_each(masks.size(), [&](std::size_t i) {
      const SnappedPoints points = snap(shape_, planes_[i], resolution_);
      const std::vector<ContourEdge> contours = views_.contours(i, points);
      masks[i] = views_.fill(contours, views_.flat(i, points));
      far[i] = far_contours(contours, masks[i]);
    });
    views_.look_for(SomePixels(far), for_each);
    for_each(masks.size(), [&](std::size_t i) { trace(i, far[i], masks[i]); });
  }

 private:
  void trace(std::size_t view, const BitImage& far, BitImage& mask) const {
    if (!views_.may_have_thin(view)) return;
    const SnappedPoints points = snap(shape_, planes_[view], resolution_);
    trace_thin(mask, near_to(far, views_.found(view, points)), views_.flat(view, points));
  }

  const NormalizedShape& shape_;
  std::span<const ViewPlane> planes_;
  int resolution_;
  ContourViews views_;
};

}  // namespace

std::vector<BitImage> draw_by_contours(const NormalizedShape& shape,
                                       std::span<const Triangle> neighbours,
                                       std::span<const ViewPlane> planes, int resolution,
                                       const ForEach& for_each) {
  std::vector<BitImage> masks(planes.size());
  for (std::size_t first = 0; first < planes.size(); first += kMostViews) {
    const auto some = planes.subspan(first, std::min(kMostViews, planes.size() - first));
    ContourSilhouettes(shape, neighbours, some, resolution, for_each)
        .draw(std::span(masks).subspan(first, some.size()), for_each);
  }
  return masks;
}

}  // namespace marrow
