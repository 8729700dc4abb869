// What a point sees across a line, and what it remembers of it.
#include <surface_probe_detail.hpp>

#include <algorithm>

#include "catch.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;
using Catch::Matchers::WithinAbs;

namespace {

/// A long box in its own frame, its middle at the origin.
class BoxProbe {
 public:
  BoxProbe()
      : shape_(of(make_box({3, 0.5, 0.4}))),
        scene_(shape_, SurfaceScene::Use::Questions),
        probe_({shape_, scene_, projections_, 0.01}, {}) {}

  const SurfaceProbe& operator*() const { return probe_; }
  double least_width() const { return std::min({extent().x, extent().y, extent().z}); }
  /// Unit vector along the box.
  Vec3 along() const {
    const Vec3 e = extent();
    return e.x > e.y && e.x > e.z ? Vec3{1, 0, 0} : e.y > e.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  }

 private:
  static NormalizedShape of(const Shape& shape) { return apply(normalize(shape), shape); }

  Vec3 extent() const { return shape_.high - shape_.low; }

  NormalizedShape shape_;
  SurfaceScene scene_;
  Projections projections_{std::span<const StereoImages>{}};
  SurfaceProbe probe_;
};

bool are_alike(const SeenWalls& a, const SeenWalls& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
    return x.has_value() == y.has_value() && (!x || x->position == y->position);
  });
}

}  // namespace

TEST_CASE("surface probe: a flat wall seen from nearby is where a ray would meet it", "[probe]") {
  const BoxProbe box;
  SeenWalls seen, anew;
  const Vec3 along = box.along();
  (*box).walls_across(along * 0.1, along, seen);
  const SeenWalls before = seen;
  const Vec3 aside = along * 0.1 + Vec3{0.003, 0.004, 0.002};
  const Walls walls = (*box).walls_across(aside, along, seen);
  const Walls truth = (*box).walls_across(aside, along, anew);
  CHECK(are_alike(seen, before));  // nothing was traced
  REQUIRE(walls.count == 4);
  REQUIRE(truth.count == 4);
  CHECK_THAT(walls.nearest, WithinAbs(truth.nearest, 1e-6));
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK_THAT(walls.pairs[i].ahead, WithinAbs(truth.pairs[i].ahead, 1e-6));
    CHECK_THAT(walls.pairs[i].back, WithinAbs(truth.pairs[i].back, 1e-6));
  }
}

TEST_CASE("surface probe: what was seen from farther away is looked at again", "[probe]") {
  const BoxProbe box;
  SeenWalls seen, anew;
  const Vec3 along = box.along();
  (*box).walls_across({0, 0, 0}, along, seen);
  const Vec3 far = along * (0.2 * box.least_width());
  (*box).walls_across(far, along, seen);
  (*box).walls_across(far, along, anew);
  CHECK(are_alike(seen, anew));
}
