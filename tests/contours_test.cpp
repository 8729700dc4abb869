// The silhouettes of oriented surfaces by their contours, against the fill of all triangles.
#include <algorithm>

#include "catch.hpp"
#include "contour_silhouettes_detail.hpp"
#include "contour_views_detail.hpp"
#include "edge_neighbours_detail.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "scanline_fill.hpp"
#include "simd_targets.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Two boxes that run through each other, and a plate that is seen from its edge.
Shape make_crossing() {
  Shape shape = make_box({1, 0.2, 0.3});
  for (const Shape& other : {make_box({0.2, 1, 0.1}), make_box({0.9, 0, 0.8})}) {
    const auto first = static_cast<std::uint32_t>(shape.points.size());
    shape.points.insert(shape.points.end(), other.points.begin(), other.points.end());
    for (const Triangle& t : other.triangles)
      shape.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return shape;
}

std::vector<Shape> oriented_shapes() {
  Random random(51);
  const Shape egg = make_ellipsoid({0.4, 1, 0.7}, scaled(4, 2));
  return {egg,
          flipped(egg),
          doubled(egg),
          reordered(egg, random, false),
          make_ellipsoid({0.2, 1, 0.1}, scaled(5, 3)),
          make_ellipsoid({0.001, 1, 0.001}, 3),
          make_ellipsoid({0.01, 1, 0.004}, 4),
          make_box({1, 2, 0.001}),
          make_box({1, 0, 0.5}),
          make_crossing()};
}

std::vector<ViewPlane> some_planes(Random& random, std::size_t count) {
  std::vector<ViewPlane> planes{{{1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 0}}};
  while (planes.size() < count) {
    const Frame f = random.frame();
    planes.push_back({f.x, f.y});
  }
  return planes;
}

/// How often a polygon runs counter-clockwise around a point that is not on it.
int turns_around(const std::vector<ContourEdge>& polygon, LatticePoint p) {
  int turns = 0;
  for (const auto& [a, b] : polygon) {
    const std::int64_t side =
        std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{p.x - a.x} * (b.y - a.y);
    if (a.y <= p.y && b.y > p.y && side > 0) ++turns;
    if (b.y <= p.y && a.y > p.y && side < 0) --turns;
  }
  return turns;
}

bool is_on(const std::vector<ContourEdge>& polygon, LatticePoint p) {
  return std::any_of(polygon.begin(), polygon.end(), [p](const ContourEdge& e) {
    const auto& [a, b] = e;
    const std::int64_t side =
        std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{p.x - a.x} * (b.y - a.y);
    return side == 0 && p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) &&
           p.y >= std::min(a.y, b.y) && p.y <= std::max(a.y, b.y);
  });
}

}  // namespace

TEST_CASE("contours: triangles that share an edge") {
  const Shape box = make_box({1, 2, 3});
  for (const Shape& shape : {box, doubled(box), make_ellipsoid({1, 1, 1}, 3)}) {
    const auto neighbours = edge_neighbours(shape.triangles, shape.points.size());
    REQUIRE(neighbours.size() == shape.triangles.size());
    for (std::size_t t = 0; t < neighbours.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const Triangle& other = shape.triangles[neighbours[t][i]];
        const std::uint32_t from = shape.triangles[t][i], to = shape.triangles[t][(i + 1) % 3];
        CHECK(((other[0] == to && other[1] == from) || (other[1] == to && other[2] == from) ||
               (other[2] == to && other[0] == from)));
      }
  }
  Shape open = box;
  open.triangles.pop_back();
  CHECK(edge_neighbours(open.triangles, open.points.size()).empty());
  Shape twisted = box;
  std::swap(twisted.triangles[3][0], twisted.triangles[3][1]);
  CHECK(edge_neighbours(twisted.triangles, twisted.points.size()).empty());
  CHECK(edge_neighbours(unwelded(box).triangles, 36).empty());
  // An edge from a point to itself is its own other side.
  const std::vector<Triangle> folded{{0, 1, 1}, {1, 0, 0}};
  CHECK(edge_neighbours(folded, 2).size() == 2);
}

TEST_CASE("contours: a hub with many edges in no order is given up") {
  Random random(52);
  Shape fan;
  const std::uint32_t n = 20'000;
  for (std::uint32_t i = 0; i < n; ++i) fan.triangles.push_back({0, 2 + i, 2 + (i + 1) % n});
  for (std::uint32_t i = 0; i < n; ++i) fan.triangles.push_back({1, 2 + (i + 1) % n, 2 + i});
  CHECK(edge_neighbours(fan.triangles, n + 2).size() == fan.triangles.size());
  for (std::size_t i = fan.triangles.size(); i-- > 1;)
    std::swap(fan.triangles[i], fan.triangles[random.below(static_cast<std::uint32_t>(i))]);
  CHECK(edge_neighbours(fan.triangles, n + 2).empty());
}

TEST_CASE("contours: a pixel is set where they run around it or through it") {
  Random random(53);
  for (const int n : {64, 100, 256}) {
    const int steps = subpixels_of(n);
    for (int round = 0; round < 12; ++round) {
      // Corners on pixel centres, so that many edges run through others, or anywhere.
      const int unit = round % 2 == 0 ? steps : 1;
      const auto coordinate = [&] {
        return unit * (4 * steps / unit + static_cast<int>(random.below(
                                              static_cast<std::uint32_t>((n - 8) * steps / unit))));
      };
      // Counter-clockwise triangles run around everything at least as often as not at all.
      std::vector<ContourEdge> edges;
      for (int k = 0; k < 4; ++k) {
        LatticePoint a{coordinate(), coordinate()}, b{coordinate(), coordinate()},
            c{coordinate(), coordinate()};
        if (k == 3) b.y = a.y;
        if (std::int64_t{b.x - a.x} * (c.y - a.y) < std::int64_t{c.x - a.x} * (b.y - a.y))
          std::swap(b, c);
        edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
      }
      BitImage expected(n, n);
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const LatticePoint p{x * steps, y * steps};
          if (is_on(edges, p) || turns_around(edges, p) != 0) expected.set(x, y);
        }
      on_each_simd_target([&] { CHECK(fill_contours(edges, n) == expected); });
    }
  }
}

TEST_CASE("contours: more of them on a row than 16 bits can count") {
  const int n = 64, steps = subpixels_of(n);
  std::vector<ContourEdge> edges;
  const LatticePoint a{20 * steps + 1, 20 * steps + 1}, b{30 * steps + 1, 20 * steps + 1},
      c{20 * steps + 1, 30 * steps + 1};
  for (int k = 0; k < 1 << 16; ++k) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  on_each_simd_target([&] {
    const BitImage mask = fill_contours(edges, n);
    CHECK(count(mask) > 30);
    CHECK(mask == fill_contours(std::span(edges).first(3), n));
  });
}

TEST_CASE("contours: the fill of oriented surfaces") {
  Random random(54);
  for (const Shape& shape : oriented_shapes()) {
    const NormalizedShape s = apply(normalize(shape), shape);
    const auto neighbours = edge_neighbours(s.triangles, s.x.size());
    REQUIRE_FALSE(neighbours.empty());
    for (const int n : {64, 100, 256}) {
      const auto planes = some_planes(random, 11);
      std::vector<BitImage> expected;
      for (const ViewPlane& plane : planes)
        expected.push_back(scanline_fill(snap(s, plane, n), s.triangles, n));
      on_each_simd_target([&] {
        const ContourViews views(s, neighbours, planes, n, for_each_in_turn);
        for (std::size_t i = 0; i < planes.size(); ++i) {
          const SnappedPoints points = snap(s, planes[i], n);
          CHECK(views.fill(views.contours(i, points), views.flat(i, points)) == expected[i]);
        }
      });
    }
  }
}

TEST_CASE("contours: silhouettes are those of single images") {
  Random random(55);
  for (const Shape& shape : oriented_shapes()) {
    const NormalizedShape s = apply(normalize(shape), shape);
    const auto neighbours = edge_neighbours(s.triangles, s.x.size());
    for (const int n : {64, 256}) {
      const auto planes = some_planes(random, 67);  // more than go together
      std::vector<BitImage> expected;
      for (const ViewPlane& plane : planes) expected.push_back(draw_silhouette(s, plane, n));
      on_each_simd_target(
          [&] { CHECK(draw_by_contours(s, neighbours, planes, n, for_each_in_turn) == expected); });
      CHECK(draw_silhouettes(s, planes, n) == expected);
    }
  }
}

TEST_CASE("contours: thin parts leave a trace") {
  const Shape rod = make_ellipsoid({0.001, 1, 0.001}, 3);
  const NormalizedShape s = apply(normalize(rod), rod);
  const ViewPlane plane{{1, 0, 0}, {0, 1, 0}};
  const std::vector<ViewPlane> planes(9, plane);
  const auto neighbours = edge_neighbours(s.triangles, s.x.size());
  const BitImage filled = scanline_fill(snap(s, plane, 64), s.triangles, 64);
  const auto masks = draw_by_contours(s, neighbours, planes, 64, for_each_in_turn);
  CHECK(count(masks[0]) > count(filled) + 30);
}
