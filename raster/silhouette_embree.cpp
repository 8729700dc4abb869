#include <marrow/silhouette.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "surface_scene_detail.hpp"

namespace marrow {

namespace {

constexpr int kSide = 4;      // of a block of pixels whose sixteen rays run together
constexpr double kStart = 2;  // of the rays before the plane through the origin: outside the ball

/// The rays through the pixel centres of one block of an image.
class BlockRays {
 public:
  BlockRays(const ViewPlane& plane, int resolution) : plane_(plane), pixels_{resolution} {
    const Vec3 along = cross(plane.u, plane.v);
    start_ = along * -kStart;
    valid_.fill(-1);
    for (std::size_t i = 0; i < valid_.size(); ++i) {
      rays_.dir_x[i] = static_cast<float>(along.x);
      rays_.dir_y[i] = static_cast<float>(along.y);
      rays_.dir_z[i] = static_cast<float>(along.z);
      rays_.tnear[i] = rays_.time[i] = 0;
      rays_.mask[i] = ~0U;
      rays_.id[i] = rays_.flags[i] = 0;
    }
  }

  /// Sets the pixels of the block at (x0, y0) whose rays meet the scene.
  void fill(BitImage& mask, RTCScene scene, int x0, int y0) {
    for (int i = 0; i < kSide * kSide; ++i) aim(i, x0 + i % kSide, y0 + i / kSide);
    occlude(valid_.data(), scene, rays_);
    for (int i = 0; i < kSide * kSide; ++i) {
      const int x = x0 + i % kSide, y = y0 + i / kSide;
      if (rays_.tfar[i] < 0 && mask.contains(x, y)) mask.set(x, y);
    }
  }

 private:
  void aim(int i, int x, int y) {
    const Vec3 p = start_ + plane_.u * pixels_.to_length(x) + plane_.v * pixels_.to_length(y);
    rays_.org_x[i] = static_cast<float>(p.x);
    rays_.org_y[i] = static_cast<float>(p.y);
    rays_.org_z[i] = static_cast<float>(p.z);
    rays_.tfar[i] = std::numeric_limits<float>::infinity();
  }

  ViewPlane plane_;
  PixelGrid pixels_;
  Vec3 start_;
  alignas(64) std::array<int, kSide * kSide> valid_;
  RTCRay16 rays_;
};

struct PixelRange {
  int first, last;
};

/// The pixels that a box covers along one axis of the image, from a multiple of kSide on.
PixelRange covered(const RTCBounds& box, const Vec3& axis, int resolution) {
  const auto middle = [](float low, float high) { return 0.5 * (double{low} + high); };
  const auto half = [](float low, float high) { return 0.5 * (double{high} - low); };
  const double centre = axis.x * middle(box.lower_x, box.upper_x) +
                        axis.y * middle(box.lower_y, box.upper_y) +
                        axis.z * middle(box.lower_z, box.upper_z);
  const double reach = std::abs(axis.x) * half(box.lower_x, box.upper_x) +
                       std::abs(axis.y) * half(box.lower_y, box.upper_y) +
                       std::abs(axis.z) * half(box.lower_z, box.upper_z);
  const PixelGrid pixels{resolution};
  const double first = std::max(std::floor(pixels.to_pixels(centre - reach)), 0.0);
  const double last = std::min(std::ceil(pixels.to_pixels(centre + reach)), resolution - 1.0);
  return {static_cast<int>(first) / kSide * kSide, static_cast<int>(last)};
}

}  // namespace

BitImage fill_by_rays(const SurfaceScene& surface, const ViewPlane& plane, int resolution) {
  BitImage mask(resolution, resolution);
  RTCScene scene = surface.embree().scene;
  RTCBounds box;
  rtcGetSceneBounds(scene, &box);
  if (!(box.lower_x <= box.upper_x)) return mask;  // no triangles
  const PixelRange columns = covered(box, plane.u, resolution);
  const PixelRange rows = covered(box, plane.v, resolution);
  BlockRays rays(plane, resolution);
  for (int y = rows.first; y <= rows.last; y += kSide)
    for (int x = columns.first; x <= columns.last; x += kSide) rays.fill(mask, scene, x, y);
  return mask;
}

}  // namespace marrow
