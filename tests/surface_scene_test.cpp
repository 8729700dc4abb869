#include <marrow/surface_scene.hpp>

#include "catch.hpp"
#include "graphs.hpp"
#include "mesh_checks.hpp"
#include "random.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// The corners as the scene has them.
Shape as_shape(const NormalizedShape& n) {
  Shape shape;
  for (std::size_t i = 0; i < n.x.size(); ++i)
    shape.points.push_back({double{n.x[i]}, double{n.y[i]}, double{n.z[i]}});
  shape.triangles = n.triangles;
  return shape;
}

}  // namespace

TEST_CASE("the nearest point is that of all triangles", "[surface-scene]") {
  Random random(3);
  Shape soup = make_soup(random, 60, 80);
  std::erase_if(soup.triangles, [](const Triangle& t) {  // the slow way asks for an area
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  const NormalizedShape own = as_normalized(soup);
  const Shape shape = as_shape(own);
  for (const auto use : {SurfaceScene::Use::Images, SurfaceScene::Use::Questions}) {
    const SurfaceScene scene(own, use);
    for (int k = 0; k < 200; ++k) {
      const Vec3 p = random.vector();
      const double expected = distance_to_surface(shape, p);
      const auto hit = scene.nearest(p, 4);
      REQUIRE(hit.has_value());
      CHECK(hit->distance == Approx(expected).margin(1e-12));
      CHECK(distance(hit->position, p) == Approx(hit->distance).margin(1e-12));
      const auto& t = shape.triangles[hit->triangle];
      CHECK(distance_to_triangle(hit->position, shape.points[t[0]], shape.points[t[1]],
                                 shape.points[t[2]]) < 1e-12);
      CHECK_FALSE(scene.nearest(p, 0.99 * expected - 1e-9).has_value());
      CHECK(scene.nearest(p, 1.01 * expected + 1e-9).has_value());
    }
  }
}

TEST_CASE("only triangles that count are near", "[surface-scene]") {
  const NormalizedShape own = as_normalized(make_box({0.5, 0.5, 0.5}));
  const SurfaceScene scene(own);
  const Vec3 p{0.1, 0, 0.3};
  CHECK(scene.nearest(p, 4)->distance == Approx(0.2));
  const auto not_on_top = [](const SurfaceHit& hit) { return hit.position.z < 0.49; };
  CHECK(scene.nearest(p, 4, not_on_top)->distance == Approx(0.4));
  CHECK_FALSE(scene.nearest(p, 4, [](const SurfaceHit&) { return false; }).has_value());
}

TEST_CASE("among equal answers the lowest triangle is given", "[surface-scene]") {
  // All faces of the box twice: whichever the tree finds first, the first copy answers.
  const NormalizedShape own = as_normalized(doubled(make_box({0.5, 0.5, 0.5})));
  for (const auto use : {SurfaceScene::Use::Images, SurfaceScene::Use::Questions}) {
    const SurfaceScene scene(own, use);
    Random random(5);
    for (int k = 0; k < 50; ++k) {
      const Vec3 p = random.vector() * 0.4;
      CHECK(scene.nearest(p, 4)->triangle < 12);
      CHECK(scene.first_hit(p, normalized(random.vector()), 4)->triangle < 12);
    }
    CHECK(scene.nearest({0, 0, 0}, 4)->triangle == 0);
  }
}

TEST_CASE("rays meet the surface where it is", "[surface-scene]") {
  const NormalizedShape own = as_normalized(make_ellipsoid({0.5, 0.9, 0.7}, 3));
  const Shape shape = as_shape(own);
  const SurfaceScene scene(own);
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    const Vec3 from = random.vector() * 0.3, way = normalized(random.vector());
    const auto hit = scene.first_hit(from, way, 4);
    REQUIRE(hit.has_value());
    CHECK(distance_to_surface(shape, hit->position) < 1e-6);
    CHECK(distance(from + way * hit->distance, hit->position) < 1e-12);
    CHECK_FALSE(scene.first_hit(from, way, 0.999 * hit->distance).has_value());

    const Vec3 outside = from - way * 3.0;
    const auto through = scene.all_hits(outside, way, 8);
    REQUIRE(through.size() >= 2);  // three or four where it runs through an edge
    CHECK(through.front().distance < through.back().distance);
    CHECK(dot(scene.normal(through.front().triangle), way) < 0);
    CHECK(dot(scene.normal(through.back().triangle), way) > 0);
    CHECK(through.back().distance == Approx(hit->distance + 3).margin(1e-9));
    CHECK_FALSE(scene.first_hit(outside, -way, 8).has_value());
  }
}

TEST_CASE("nothing is near no surface", "[surface-scene]") {
  const NormalizedShape nothing;
  const SurfaceScene scene(nothing);
  CHECK_FALSE(scene.nearest({0, 0, 0}, 4).has_value());
  CHECK_FALSE(scene.first_hit({0, 0, 0}, {1, 0, 0}, 4).has_value());
  CHECK(scene.all_hits({0, 0, 0}, {1, 0, 0}, 4).empty());
}
