#include <marrow/shape_summary.hpp>

#include "catch.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// A square ring of eight boxes' outlines, welded: a torus of `n` x `m` quads.
Shape make_torus(std::uint32_t n, std::uint32_t m) {
  Shape s;
  const Vec3 ring[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const Vec3 out = ring[i % 4] + Vec3{0, 0, 0.001} * static_cast<double>(i >> 2);
      s.points.push_back(out * (2 + ring[j % 4].x) + Vec3{0, 0, ring[j % 4].y});
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const auto at = [&](std::uint32_t a, std::uint32_t b) { return a % n * m + b % m; };
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return s;
}

Shape together(Shape a, const Shape& b, const Vec3& offset = {}) {
  const auto first = static_cast<std::uint32_t>(a.points.size());
  for (const Vec3& p : b.points) a.points.push_back(p + offset);
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

}  // namespace

TEST_CASE("summary: a closed shape, welded or not, in any order") {
  Random random(1);
  const Shape egg = make_ellipsoid({1, 2, 3}, 2);
  for (const Shape& shape : {egg, flipped(egg), unwelded(egg), reordered(egg, random)}) {
    const ShapeSummary s = summarize(shape);
    CHECK(s.points == shape.points.size());
    CHECK(s.triangles == 128);
    CHECK(s.unused_points == 0);
    CHECK(s.flat_triangles == 0);
    CHECK(s.components == 1);
    CHECK(s.open_edges == 0);
    CHECK(s.crowded_edges == 0);
    CHECK(s.handles == std::size_t{0});
    CHECK(s.is_closed());
    CHECK(s.bounds.low == Vec3{-1, -2, -3});
    CHECK(s.bounds.high == Vec3{1, 2, 3});
    CHECK(s.bounds.diagonal() == Approx(2 * std::sqrt(14)));
  }
}

TEST_CASE("summary: handles of several parts add up") {
  const Shape torus = make_torus(4, 4);
  CHECK(summarize(torus).handles == std::size_t{1});
  const ShapeSummary s = summarize(together(torus, make_torus(4, 4), {9, 0, 0}));
  CHECK(s.handles == std::size_t{2});
  CHECK(s.components == 2);
  // Two parts that share one place are one, and its handles cannot be told.
  CHECK(summarize(together(make_box({1, 1, 1}), make_box({1, 1, 1}), {2, 2, 2})).components == 1);
}

TEST_CASE("summary: open and crowded edges") {
  Shape box = make_box({1, 1, 1});
  const Triangle last = box.triangles.back();
  box.triangles.pop_back();
  ShapeSummary s = summarize(box);
  CHECK(s.open_edges == 3);
  CHECK_FALSE(s.is_closed());
  CHECK_FALSE(s.handles);
  box.triangles.push_back(last);
  box.triangles.push_back(last);
  s = summarize(box);
  CHECK(s.open_edges == 0);
  CHECK(s.crowded_edges == 3);
  CHECK_FALSE(s.handles);
  CHECK(s.is_closed());
}

TEST_CASE("summary: unused points, flat triangles, and shapes with nothing in them") {
  Shape box = make_box({1, 1, 1});
  box.points.push_back({100, 0, 0});
  box.triangles.push_back({0, 0, 1});
  box.triangles.push_back({8, 8, 8});
  ShapeSummary s = summarize(box);
  CHECK(s.unused_points == 0);
  CHECK(s.flat_triangles == 2);
  CHECK(s.handles == std::size_t{0});
  CHECK(s.bounds.high.x == 100);
  box.triangles.pop_back();
  s = summarize(box);
  CHECK(s.unused_points == 1);
  CHECK(s.bounds.high.x == 1);
  CHECK(s.components == 1);

  s = summarize({});
  CHECK(s.points == 0);
  CHECK(s.components == 0);
  CHECK(s.bounds.is_empty);
  CHECK_FALSE(s.is_closed());
  CHECK_FALSE(s.handles);
  s = summarize({{{1, 2, 3}, {4, 5, 6}}, {}});
  CHECK(s.unused_points == 0);
  CHECK(s.components == 0);
  CHECK(s.bounds.high == Vec3{4, 5, 6});
  s = summarize({{{1, 2, 3}}, {{0, 0, 0}}});
  CHECK_FALSE(s.is_closed());
  CHECK_FALSE(s.handles);
}

TEST_CASE("bounds: the diagonal of huge and tiny boxes neither overflows nor vanishes") {
  for (const double scale : {1e-300, 1.0, 1e300}) {
    Bounds b;
    CHECK(b.diagonal() == 0);
    b.add({-scale, 0, 0});
    CHECK(b.diagonal() == 0);
    b.add({scale, 2 * scale, -scale});
    CHECK(b.diagonal() / scale == Approx(3));
  }
}
