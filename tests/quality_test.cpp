// How good a skeleton is for its shape, where that is known.
#include <marrow/error.hpp>
#include <marrow/quality.hpp>

#include <analytic_shapes.hpp>
#include <tbb/global_control.h>
#include <voxelise.hpp>

#include "ball_union_detail.hpp"
#include "catch.hpp"
#include "enclosure_detail.hpp"
#include "graphs.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

AnalyticShape make(const char* name) { return make_analytic_shape(name, {0.5}); }

CurveSkeleton moved(CurveSkeleton skeleton, const Vec3& by) {
  for (auto& n : skeleton.nodes) n.position += by;
  return skeleton;
}

/// A rod of square section along y, and a line through it at `x`.
Shape rod() { return make_box({1, 10, 1}); }
CurveSkeleton line_at(double x, double from = -9, double to = 9) {
  return {{{{x, from, 0}, 1}, {{x, to, 0}, 1}}, {{0, 1}}};
}

bool same(const std::optional<Reconstruction>& a, const std::optional<Reconstruction>& b) {
  return a->mean == b->mean && a->p95 == b->p95 && a->most == b->most && a->covered == b->covered;
}

}  // namespace

TEST_CASE("the true centre lines of analytic shapes are good", "[quality]") {
  for (const char* name : {"capsule", "torus", "double-torus", "rings", "star", "vessel-tree"}) {
    INFO(name);
    const AnalyticShape made = make(name);
    const SkeletonQuality q = measure_quality(made.shape, made.truth);
    CHECK(q.shape_components == made.components);
    CHECK(q.shape_cycles == made.cycles);
    CHECK(q.outside == 0);
    CHECK(q.outside_most == 0);
    REQUIRE(q.centredness);
    CHECK(q.centredness->mean < 0.06);
    CHECK(q.centredness->samples > 50);
    CHECK(q.reconstruction->mean < 0.003);
    CHECK(q.reconstruction->covered > 0.95);
    CHECK(*q.radius_error < 0.005);
  }
}

TEST_CASE("a line off the middle has the figures that geometry says", "[quality]") {
  const double diagonal = std::sqrt(4.0 + 400 + 4);
  const SkeletonQuality middle = measure_quality(rod(), line_at(0));
  CHECK(middle.length == Approx(18 / diagonal));
  CHECK(middle.centredness->mean == Approx(0).margin(1e-6));
  CHECK(*middle.radius_error == Approx(0).margin(1e-6));
  // The corners of the section are sqrt(2) - 1 away from the ball; the middles of sides touch it.
  CHECK(middle.reconstruction->most < std::sqrt(3.0) / diagonal);
  CHECK(middle.reconstruction->most > (std::sqrt(2.0) - 1) / diagonal);

  // Half way to a wall: along x, (1.5 - 0.5) / 2; along z, nothing; 0.5 of the radius is wrong.
  const SkeletonQuality off = measure_quality(rod(), line_at(0.5));
  CHECK(off.outside == 0);
  CHECK(off.centredness->mean > 0.25);
  CHECK(off.centredness->mean < 0.5);
  CHECK(*off.radius_error == Approx(0.5 / diagonal).epsilon(1e-5));

  // A quarter of the line is outside; it gets 6 away from the end face.
  const SkeletonQuality out = measure_quality(rod(), line_at(0, -8, 16));
  CHECK(*out.outside == Approx(0.25).margin(0.01));
  CHECK(*out.outside_most == Approx(6 / diagonal).epsilon(0.02));

  const SkeletonQuality beside = measure_quality(rod(), line_at(2));
  CHECK(beside.outside == 1);
  CHECK(*beside.outside_most == Approx(1 / diagonal).epsilon(1e-5));
  CHECK_FALSE(beside.centredness);
  CHECK_FALSE(beside.radius_error);
}

TEST_CASE("bad skeletons are worse in every figure", "[quality]") {
  const AnalyticShape made = make("y");
  const SkeletonQuality good = measure_quality(made.shape, made.truth);
  const SkeletonQuality bad = measure_quality(made.shape, moved(made.truth, {0.1, 0.1, 0.25}));
  CHECK(*bad.outside > *good.outside + 0.1);
  CHECK(bad.centredness->mean > good.centredness->mean + 0.2);
  CHECK(bad.reconstruction->mean > 3 * good.reconstruction->mean);
  CHECK(bad.reconstruction->covered < good.reconstruction->covered - 0.1);
  CHECK(*bad.radius_error > *good.radius_error + 0.01);
}

TEST_CASE("soups, turned and doubled triangles enclose what the closed shape does", "[quality]") {
  const AnalyticShape made = make("y");
  const CurveSkeleton skeleton = moved(made.truth, {0.1, 0.1, 0.25});
  const SkeletonQuality closed = measure_quality(made.shape, skeleton);
  Random random(7);
  for (const Shape& shape : {unwelded(made.shape), flipped(made.shape), doubled(made.shape),
                             reordered(made.shape, random, false), reordered(made.shape, random)}) {
    const SkeletonQuality other = measure_quality(shape, skeleton);
    CHECK(*other.outside == Approx(*closed.outside).margin(5e-3));
    CHECK(other.centredness->mean == Approx(closed.centredness->mean).margin(2e-3));
    CHECK(*other.radius_error == Approx(*closed.radius_error).margin(1e-3));
  }
}

TEST_CASE("holes do not make a shape a void, a sheet encloses nothing", "[quality]") {
  AnalyticShape made = make("capsule");
  auto& triangles = made.shape.triangles;
  for (std::size_t i = triangles.size(); i-- > 0;)
    if (i % 11 == 0) triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(i));
  const SkeletonQuality open = measure_quality(made.shape, made.truth);
  CHECK_FALSE(open.shape_components);
  CHECK_FALSE(open.shape_cycles);
  CHECK(open.outside == 0);
  REQUIRE(open.centredness);
  CHECK(open.centredness->mean < 0.05);

  const AnalyticShape sheet = make("gingerbread-man");
  const SkeletonQuality flat = measure_quality(sheet.shape, moved(sheet.truth, {0, 0, 0.01}));
  CHECK_FALSE(flat.outside);
  CHECK_FALSE(flat.centredness);
  CHECK_FALSE(flat.radius_error);
  CHECK(flat.reconstruction);
}

TEST_CASE("overlapping parts are inside too", "[quality]") {
  const AnalyticShape made = make("star-union");
  const SkeletonQuality q = measure_quality(made.shape, made.truth);
  CHECK(q.outside == 0);
}

TEST_CASE("clouds and volumes have the figures that they define", "[quality]") {
  const AnalyticShape made = make("torus");
  const SkeletonQuality cloud = measure_quality(Shape{made.shape.points, {}}, made.truth);
  CHECK_FALSE(cloud.shape_components);
  CHECK_FALSE(cloud.outside);
  CHECK_FALSE(cloud.centredness);
  CHECK_FALSE(cloud.inscribed_reconstruction);
  CHECK(cloud.reconstruction->mean < 0.002);
  CHECK(cloud.reconstruction->covered == 1);

  const SkeletonQuality volume = measure_quality(voxelise(made.shape, 64), made.truth);
  CHECK(volume.shape_components == 1);
  CHECK(volume.shape_cycles == 1);
  CHECK(volume.outside == 0);
  CHECK(volume.centredness->mean < 0.1);
  CHECK(volume.reconstruction->mean < 0.005);
}

TEST_CASE("the section radii are what a skeleton tells a shape by", "[quality]") {
  CurveSkeleton skeleton = line_at(0);
  const SkeletonQuality without = measure_quality(rod(), skeleton);
  for (auto& n : skeleton.nodes) n.section_radius = 1.2;
  const SkeletonQuality with = measure_quality(rod(), skeleton);
  CHECK(with.reconstruction->mean < without.reconstruction->mean);
  CHECK(with.radius_error == without.radius_error);
}

TEST_CASE("figures do not depend on threads, units or place", "[quality]") {
  const AnalyticShape made = make("double-torus");
  const SkeletonQuality all = measure_quality(made.shape, made.truth);
  for (const std::size_t threads : {1U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const SkeletonQuality q = measure_quality(made.shape, made.truth);
    CHECK(q.outside == all.outside);
    CHECK(q.centredness->mean == all.centredness->mean);
    CHECK(q.radius_error == all.radius_error);
    CHECK(same(q.reconstruction, all.reconstruction));
    CHECK(same(q.inscribed_reconstruction, all.inscribed_reconstruction));
  }
  CurveSkeleton large = made.truth;
  for (auto& n : large.nodes) n.position = n.position * 1024, n.radius *= 1024;
  const SkeletonQuality scaled = measure_quality(moved(made.shape, Frame{}, {}, 1024), large);
  CHECK(scaled.centredness->mean == Approx(all.centredness->mean));
  CHECK(scaled.reconstruction->mean == Approx(all.reconstruction->mean));
}

TEST_CASE("faults of skeletons are told and refused", "[quality]") {
  const CurveSkeleton good{{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}}, {{0, 1}, {1, 2}}};
  CHECK_FALSE(fault_of(good));
  const auto faulty = [&](auto change) {
    CurveSkeleton skeleton = good;
    change(skeleton);
    CHECK_THROWS_AS(measure_quality(rod(), skeleton), Error);
    return fault_of(skeleton).value_or("");
  };
  CHECK(faulty([](auto& s) { s.nodes[1].position.y = NAN; }) == "node 1 is not at a finite place");
  CHECK(faulty([](auto& s) { s.nodes[2].radius = 0; }) == "node 2 has no radius");
  CHECK(
      faulty([](auto& s) { s.nodes[2].section_radius = -1; }).starts_with("node 2 has a section"));
  CHECK(faulty([](auto& s) { s.edges[1] = {1, 3}; }) == "edge 1 has an end that is no node");
  CHECK(faulty([](auto& s) {
          s.edges[0] = {0, 0};
        }) == "edge 0 is not from a lower to a higher node");
  CHECK(faulty([](auto& s) { s.edges[1] = {0, 1}; }) == "edge 1 is given twice, or out of order");
  CHECK(faulty([](auto& s) { s = {}; }).empty());
  CHECK(faulty([](auto& s) { s.nodes[0].position.x = 1e9; }).empty());
}

TEST_CASE("a skeleton of one node has no length", "[quality]") {
  const CurveSkeleton point{{{{0, 0, 0}, 1}}, {}};
  const SkeletonQuality q = measure_quality(make_ellipsoid({1, 1, 1}, 4), point);
  CHECK(q.length == 0);
  CHECK_FALSE(q.outside);
  CHECK_FALSE(q.centredness);
  CHECK(q.reconstruction->mean < 0.002);
  CHECK(*q.radius_error < 0.002);
}

TEST_CASE("the union of balls is that of very many balls", "[quality]") {
  const CurveSkeleton skeleton{{{{0, 0, 0}, 0.3},
                                {{1, 0, 0}, 0.1},
                                {{1, 1, 0}, 0.4},
                                {{0, 0, 0.1}, 0.05},
                                {{-1, -1, -1}, 0.2}},
                               {{0, 1}, {0, 3}, {1, 2}}};
  std::vector<double> radii;
  for (const auto& n : skeleton.nodes) radii.push_back(n.radius);
  const BallUnion balls(skeleton, radii);
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random.vector() * 1.5;
    double least = distance(p, skeleton.nodes[4].position) - 0.2;
    for (const auto& [a, b] : skeleton.edges)
      for (int k = 0; k <= 2000; ++k) {
        const auto &from = skeleton.nodes[a], &to = skeleton.nodes[b];
        const double t = k / 2000.0;
        least = std::min(least, distance(p, from.position * (1 - t) + to.position * t) -
                                    (from.radius * (1 - t) + to.radius * t));
      }
    CHECK(balls.distance(p) == Approx(least).margin(1e-5));
  }
}
