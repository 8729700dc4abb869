#include <marrow/point_silhouette.hpp>
#include <marrow/stereo_images.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

#include "fill_detail.hpp"
#include "medial_axis_maker_detail.hpp"
#include "spare_detail.hpp"

namespace marrow {

namespace {

constexpr int kFrameResolution = 64;  // of the silhouette that a frame is turned to
constexpr std::int64_t kFewPixels = 8;

/// Sums over points (x, y); integers, so that any order gives the same.
struct PlaneMoments {
  std::int64_t n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(std::int64_t px, std::int64_t py) {
    ++n;
    x += px, y += py;
    xx += px * px, xy += px * py, yy += py * py;
  }
};

/// Major axis (unit vector in the plane) of a set of points; (0, 1) where no direction stands out.
std::pair<double, double> major_axis(const PlaneMoments& m) {
  const auto n = static_cast<double>(m.n);
  const auto cross_moment = [n](std::int64_t ab, std::int64_t a, std::int64_t b) {
    return static_cast<double>(ab) / n - static_cast<double>(a) / n * (static_cast<double>(b) / n);
  };
  const double xx = cross_moment(m.xx, m.x, m.x), xy = cross_moment(m.xy, m.x, m.y),
               yy = cross_moment(m.yy, m.y, m.y);
  const double half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
  if (!(root > 1e-9 * (xx + yy))) return {0, 1};
  // Eigenvector of the greater eigenvalue, from the row that does not cancel.
  double ax = half >= 0 ? half + root : xy;
  double ay = half >= 0 ? xy : root - half;
  const double norm = std::sqrt(ax * ax + ay * ay);
  ax /= norm, ay /= norm;
  return ay < 0 || (ay == 0 && ax < 0) ? std::pair{-ax, -ay} : std::pair{ax, ay};
}

PlaneMoments pixel_moments(const BitImage& mask) {
  PlaneMoments m;
  for (int y = 0; y < mask.height(); ++y)
    for (int i = 0; i < mask.words_per_row(); ++i)
      for (auto word = mask.row(y)[i]; word != 0; word &= word - 1)
        m.add(64 * i + std::countr_zero(word), y);
  return m;
}

PlaneMoments point_moments(const SnappedPoints& points) {
  PlaneMoments m;
  for (std::size_t i = 0; i < points.size(); ++i) m.add(points.x(i), points.y(i));
  return m;
}

/// The silhouette's box and the pixels next to it.
PixelBox box_around(const BitImage& silhouette) {
  const PixelBox box = bounding_box(silhouette);
  return {std::max(box.left - 1, 0), std::min(box.right + 1, silhouette.width()),
          std::max(box.top - 1, 0), std::min(box.bottom + 1, silhouette.height())};
}

/// What follows from a silhouette.
ViewImage view_of(const ViewPlane& plane, BitImage silhouette, MedialAxisMaker& medial_axis) {
  ViewImage image{plane, std::move(silhouette), {}, {}, {}};
  image.distance = distance_transform(image.silhouette);
  image.axis = medial_axis(image.distance);
  const BitImage off_axis = complement(to_image(image.axis, image.silhouette.width()));
  image.to_axis = distance_transform(off_axis, box_around(image.silhouette));
  return image;
}

}  // namespace

StereoPair stereo_pair(const NormalizedShape& shape, const Vec3& direction) {
  const Frame any = frame_along(direction);
  const SnappedPoints points = snap(shape, {any.x, any.y}, kFrameResolution);
  PlaneMoments m =
      pixel_moments(shape.is_point_cloud()
                        ? draw_point_silhouette(shape, {any.x, any.y}, kFrameResolution)
                        : fill(points, shape.triangles, facing_of(shape), kFrameResolution).mask);
  if (m.n < kFewPixels) m = point_moments(points);  // a plate seen from its edge
  const auto [ax, ay] = major_axis(m);
  const Vec3 y = any.x * ax + any.y * ay;
  return {{cross(y, any.z), y, any.z}};
}

StereoImages draw_stereo_images(const NormalizedShape& shape, const StereoPair& pair,
                                int resolution, const SurfaceScene* scene) {
  MedialAxisMaker medial_axis;
  const auto draw = [&](const ViewPlane& plane) {
    return view_of(plane, draw_silhouette(shape, plane, resolution, scene), medial_axis);
  };
  return {pair, draw(pair.front()), draw(pair.side())};
}

std::vector<StereoImages> draw_stereo_images(const NormalizedShape& shape,
                                             std::span<const StereoPair> pairs, int resolution,
                                             const SurfaceScene* scene, const ForEach& for_each) {
  std::vector<ViewPlane> planes;
  for (const StereoPair& pair : pairs)
    planes.push_back(pair.front()), planes.push_back(pair.side());
  std::vector<BitImage> masks = draw_silhouettes(shape, planes, resolution, scene, for_each);
  std::vector<StereoImages> images(pairs.size());
  Spare<MedialAxisMaker> makers;
  for_each(pairs.size(), [&](std::size_t i) {
    makers.use([&](MedialAxisMaker& medial_axis) {
      const auto view = [&](std::size_t k) {
        return view_of(planes[k], std::move(masks[k]), medial_axis);
      };
      images[i] = {pairs[i], view(2 * i), view(2 * i + 1)};
    });
  });
  return images;
}

}  // namespace marrow
