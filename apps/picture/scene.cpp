#include "picture/scene.hpp"

#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "picture/legend.hpp"

namespace marrow {
namespace {

constexpr int kMinSize = 64;
constexpr int kMaxSize = 16384;
constexpr double kFarthest = 4;  // from the middle of the shape, whose half-diagonal is 1
constexpr float kHaziest = 0.25F;

Sizes sizes_of(const RenderOptions& options) {
  const float unit = static_cast<float>(std::min(options.width, options.height * 4 / 3)) / 1600.0F;
  Sizes sizes{};
  sizes.dot = std::max(1.0F, 2.0F * unit);
  sizes.tube = std::max(1.2F, 4.0F * unit);
  sizes.outline = std::max(0.5F, 1.1F * unit);
  sizes.disc = std::max(0.8, 1.6 * static_cast<double>(unit));
  sizes.legend = options.legend ? static_cast<int>(20 * sizes.dot) : 0;
  return sizes;
}

/// Thinner tubes where the limbs are so thin that these would hide them. Balls stay easy to see.
void spare_thin_limbs(Sizes& sizes, const CurveSkeleton& skeleton, double pixels_per_unit) {
  const float full = sizes.tube;
  if (!skeleton.nodes.empty()) {
    std::vector<double> radii;
    for (const auto& node : skeleton.nodes) radii.push_back(node.radius);
    const auto quarter = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 4);
    std::nth_element(radii.begin(), quarter, radii.end());
    const double half_limb = 0.45 * *quarter * pixels_per_unit;
    if (half_limb < static_cast<double>(full)) {
      sizes.tube = std::max(static_cast<float>(half_limb), 0.6F * full);
    }
  }
  sizes.joint = std::max(1.9F * sizes.tube, 1.6F * full);
  sizes.leaf = std::max(1.75F * sizes.tube, 1.45F * full);
}

void check(const RenderOptions& options) {
  for (const int size : {options.width, options.height}) {
    if (size < kMinSize || size > kMaxSize) {
      throw Error(ErrorKind::Usage,
                  "render: a picture of " + std::to_string(options.width) + " x " +
                      std::to_string(options.height) + " pixels is out of range; take sides of " +
                      std::to_string(kMinSize) + " to " + std::to_string(kMaxSize));
    }
  }
}

/// Everything that has to fit into the views, in the pose: the shape, and as much of the skeleton
/// as is not so far away that the shape would shrink to a dot.
std::vector<Vec3> framed_points(const Shape& shape, const CurveSkeleton& skeleton,
                                const Normalization& pose) {
  std::vector<Vec3> points = drawn_points(shape);
  for (Vec3& p : points) p = pose.to_normalized(p);
  for (const auto& node : skeleton.nodes) {
    const Vec3 p = place(pose, node.position);
    if (length(p) < kFarthest) points.push_back(p);
  }
  return points;
}

Stroke ball(const Vec3& at, float radius, const Sizes& sizes) {
  Stroke stroke;
  stroke.a = stroke.b = at;
  stroke.radius = radius;
  stroke.outline = sizes.outline;
  return stroke;
}

/// How hazy a node is: the farthest of all most, the nearest not at all, and a flat skeleton, which
/// has no far end to speak of, hardly.
class Haze {
 public:
  Haze(std::span<const Vec3> places, double pixels_per_unit) {
    for (const Vec3& p : places) {
      nearest_ = std::max(nearest_, p.z);
      farthest_ = std::min(farthest_, p.z);
    }
    depth_ = std::max(nearest_ - farthest_, 0.5 * pixels_per_unit);
  }
  float at(const Vec3& place) const {
    return kHaziest * static_cast<float>((nearest_ - place.z) / depth_);
  }

 private:
  double nearest_ = -std::numeric_limits<double>::infinity();
  double farthest_ = std::numeric_limits<double>::infinity();
  double depth_ = 1;
};

}  // namespace

Scene scene_of(const Shape& shape, const CurveSkeleton& skeleton, const RenderOptions& options) {
  check(options);
  Scene scene;
  scene.sizes = sizes_of(options);
  scene.pose = pose_of(shape, skeleton);
  const Rect area{0, 0, options.width, options.height - scene.sizes.legend};
  scene.views = views_of(framed_points(shape, skeleton, scene.pose), area, options.view);
  scene.legend = {0, area.bottom(), options.width, scene.sizes.legend};
  spare_thin_limbs(scene.sizes, skeleton, scene.views[0].scale / scene.pose.length_to_input(1));
  return scene;
}

std::vector<Stroke> strokes_of(const CurveSkeleton& skeleton, const Scene& scene,
                               const View& view) {
  const Sizes& sizes = scene.sizes;
  const RadiusRange range = radius_range(skeleton);
  std::vector<Vec3> places;
  places.reserve(skeleton.nodes.size());
  for (const auto& node : skeleton.nodes) {
    places.push_back(view.project(place(scene.pose, node.position)));
  }
  const Haze haze(places, view.scale);
  std::vector<Stroke> strokes;
  for (const auto& [a, b] : skeleton.edges) {
    Stroke tube = ball(places[a], sizes.tube, sizes);
    tube.b = places[b];
    tube.haze_a = haze.at(places[a]);
    tube.haze_b = haze.at(places[b]);
    tube.value_a = range.place_of(skeleton.nodes[a].radius);
    tube.value_b = range.place_of(skeleton.nodes[b].radius);
    strokes.push_back(tube);
  }
  const std::vector<int> edges = degrees(skeleton);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (edges[i] == 2) continue;
    Stroke mark = ball(places[i], edges[i] >= 3 ? sizes.joint : sizes.leaf, sizes);
    mark.haze_a = mark.haze_b = haze.at(places[i]);
    mark.is_marked = edges[i] != 0;
    mark.colour = edges[i] >= 3 ? kJointColour : kLeafColour;
    mark.value_a = mark.value_b = range.place_of(skeleton.nodes[i].radius);
    strokes.push_back(mark);
  }
  return strokes;
}

}  // namespace marrow
