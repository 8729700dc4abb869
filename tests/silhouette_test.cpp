#include <marrow/silhouette.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "simd_targets.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Twice the signed area.
std::int64_t edge_function(const std::array<std::int64_t, 2>& a,
                           const std::array<std::int64_t, 2>& b,
                           const std::array<std::int64_t, 2>& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/// Every pixel centre against every triangle whose box holds it: all three edge functions of one
/// sign, or zero.
BitImage slow_fill(const SnappedPoints& points, const std::vector<Triangle>& triangles, int n) {
  BitImage mask(n, n);
  const int steps = subpixels_of(n);
  for (const Triangle& t : triangles) {
    std::array<std::array<std::int64_t, 2>, 3> c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = {points.x(t[i]), points.y(t[i])};
    const auto [x0, x1] = std::minmax({c[0][0], c[1][0], c[2][0]});
    const auto [y0, y1] = std::minmax({c[0][1], c[1][1], c[2][1]});
    for (int y = 0; y < n; ++y) {
      const std::int64_t py = std::int64_t{y} * steps;
      if (py < y0 || py > y1) continue;
      for (int x = 0; x < n; ++x) {
        const std::int64_t px = std::int64_t{x} * steps;
        if (px < x0 || px > x1) continue;
        const std::int64_t e0 = edge_function(c[0], c[1], {px, py}),
                           e1 = edge_function(c[1], c[2], {px, py}),
                           e2 = edge_function(c[2], c[0], {px, py});
        if ((e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0)) mask.set(x, y);
      }
    }
  }
  return mask;
}

NormalizedShape normalized_shape(const Shape& shape) { return apply(normalize(shape), shape); }

ViewPlane random_plane(Random& random) {
  const Frame f = random.frame();
  return {f.x, f.y};
}

Shape without_some_faces(Shape shape) {
  std::vector<Triangle> kept;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i)
    if (i % 5 != 0) kept.push_back(shape.triangles[i]);
  shape.triangles = kept;
  return shape;
}

SnappedPoints lattice_points(const std::vector<std::array<int, 2>>& points) {
  SnappedPoints result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result.set(i, points[i][0], points[i][1]);
  return result;
}

/// Points on the lattice of an image of side `n`, on pixel centres more often than chance has it.
SnappedPoints random_points(Random& random, int n, std::size_t count, int reach) {
  const int steps = subpixels_of(n), last = (n - 1) * steps;
  std::vector<std::array<int, 2>> points;
  std::array<int, 2> middle{};
  for (std::size_t i = 0; i < count; ++i) {
    std::array<int, 2> p{};
    for (std::size_t k = 0; k < 2; ++k) {
      if (i % 3 == 0) middle[k] = static_cast<int>(random.below(static_cast<unsigned>(last + 1)));
      const int off = static_cast<int>(random.below(static_cast<unsigned>(2 * reach + 1))) - reach;
      p[k] = std::clamp(middle[k] + off, 0, last);
      if (random.below(4) == 0) p[k] = p[k] / steps * steps;
    }
    points.push_back(p);
  }
  return lattice_points(points);
}

std::vector<Triangle> in_threes(std::size_t count) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i + 2 < count; i += 3) triangles.push_back({i, i + 1, i + 2});
  return triangles;
}

bool contains_all(const BitImage& outer, const BitImage& inner) {
  for (std::size_t i = 0; i < inner.words().size(); ++i)
    if ((inner.words()[i] & ~outer.words()[i]) != 0) return false;
  return true;
}

/// Pixels reached from (x, y) through set ones, also diagonally.
std::size_t reached_from(const BitImage& mask, int x0, int y0) {
  BitImage open = mask;
  std::vector<std::array<int, 2>> stack{{x0, y0}};
  open.clear(x0, y0);
  std::size_t reached = 0;
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    ++reached;
    for (int k = 0; k < 9; ++k) {
      const int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
      if (!open.contains(nx, ny) || !open(nx, ny)) continue;
      open.clear(nx, ny);
      stack.push_back({nx, ny});
    }
  }
  return reached;
}

BitImage draw_box(int n, int x0, int y0, int width, int height) {
  BitImage mask(n, n);
  for (int y = y0; y < y0 + height; ++y)
    for (int x = x0; x < x0 + width; ++x) mask.set(x, y);
  return mask;
}

constexpr int kResolutions[] = {64, 100, 256, 1024};

}  // namespace

TEST_CASE("lattice: a power of two of steps, and 15 bits hold the image") {
  CHECK(subpixels_of(64) == 512);
  CHECK(subpixels_of(100) == 256);
  CHECK(subpixels_of(256) == 128);
  CHECK(subpixels_of(1000) == 32);
  CHECK(subpixels_of(1024) == 32);
}

TEST_CASE("snap: nearest lattice place, within the margin and 15 bits") {
  Random random(1);
  const NormalizedShape shape = normalized_shape(make_soup(random, 400, 300));
  for (const int n : kResolutions) {
    const int steps = subpixels_of(n);
    for (int i = 0; i < 10; ++i) {
      const ViewPlane plane = random_plane(random);
      const SnappedPoints snapped = snap(shape, plane, n);
      REQUIRE(snapped.size() == shape.x.size());
      double error = 0;
      for (std::size_t k = 0; k < shape.x.size(); ++k) {
        const Vec3 p{shape.x[k], shape.y[k], shape.z[k]};
        error = std::max(
            {error, std::abs(snapped.x(k) - PixelGrid{n}.to_pixels(dot(plane.u, p)) * steps),
             std::abs(snapped.y(k) - PixelGrid{n}.to_pixels(dot(plane.v, p)) * steps)});
        for (const int c : {snapped.x(k), snapped.y(k)}) {
          CHECK(c >= 2 * steps);
          CHECK(c <= (n - 3) * steps);
        }
      }
      CHECK(error < 0.52);
    }
  }
}

TEST_CASE("snap: the same floats on every instruction set, whatever the number of points") {
  Random random(11);
  for (const std::size_t count : {1, 2, 3, 7, 8, 9, 31, 33, 1000}) {
    NormalizedShape shape;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 p = random.frame().x;
      shape.x.push_back(static_cast<float>(p.x));
      shape.y.push_back(static_cast<float>(p.y));
      shape.z.push_back(static_cast<float>(p.z));
    }
    const ViewPlane plane = random_plane(random);
    for (const int n : kResolutions) {
      const auto expected = [&](const Vec3& axis, std::size_t i) {
        const auto x = static_cast<float>(axis.x), y = static_cast<float>(axis.y),
                   z = static_cast<float>(axis.z);
        const double steps = subpixels_of(n);
        const float along = x * shape.x[i] + y * shape.y[i] + z * shape.z[i];
        const float scaled = along * static_cast<float>(steps / PixelGrid{n}.pixel());
        return static_cast<int>(scaled + static_cast<float>(0.5 * (n - 1) * steps + 0.5));
      };
      on_each_simd_target([&] {
        const SnappedPoints snapped = snap(shape, plane, n);
        REQUIRE(snapped.size() == count);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < count; ++i)
          wrong += snapped.x(i) != expected(plane.u, i) || snapped.y(i) != expected(plane.v, i);
        CHECK(wrong == 0);
      });
    }
  }
}

TEST_CASE("fill: shapes of all kinds as the definition says") {
  Random random(2);
  const Shape egg = make_ellipsoid({0.4, 1, 0.7}, scaled(3, 2));
  const Shape soup = make_soup(random, 60, 40);
  for (const Shape& shape : {egg, flipped(egg), without_some_faces(egg), doubled(egg),
                             unwelded(egg), make_box({1, 2, 0.001}), make_box({1, 0, 0.5}), soup}) {
    const NormalizedShape s = normalized_shape(shape);
    for (const int n : kResolutions) {
      for (const ViewPlane& plane : {random_plane(random), ViewPlane{{1, 0, 0}, {0, 1, 0}}}) {
        const SnappedPoints points = snap(s, plane, n);
        const BitImage mask = fill_triangles(points, s.triangles, n);
        CHECK(mask == slow_fill(points, s.triangles, n));
      }
    }
  }
}

TEST_CASE("fill: random triangles, also without area, as the definition says") {
  Random random(3);
  for (const int n : kResolutions) {
    for (int i = 0; i < 60; ++i) {
      const int reach = subpixels_of(n) * std::array{1, 2, 8, n}[static_cast<std::size_t>(i % 4)];
      SnappedPoints points = random_points(random, n, 30, reach);
      for (std::size_t k = 0; k < 6; ++k) {  // a point; a line there and back; a line
        const std::size_t from = k < 3 ? 0 : 3 + k % 2;
        points.set(k, points.x(from), points.y(from));
      }
      points.set(8, (points.x(6) + points.x(7)) / 2, (points.y(6) + points.y(7)) / 2);
      const auto triangles = in_threes(30);
      for (const Triangle& t : triangles) {
        const BitImage mask = fill_triangles(points, {&t, 1}, n);
        if (!(mask == slow_fill(points, {t}, n))) FAIL_CHECK("side " << n << ", set " << i);
      }
      CHECK(fill_triangles(points, triangles, n) == slow_fill(points, triangles, n));
    }
  }
}

TEST_CASE("fill: a centre on an edge, a corner or a flat triangle counts") {
  constexpr int kSide = 64;
  const int s = subpixels_of(kSide);
  const auto filled = [&](std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c) {
    return fill_triangles(lattice_points({a, b, c}), in_threes(3), kSide);
  };
  CHECK(filled({s, s}, {3 * s, s}, {s, 3 * s}) == filled({s, s}, {s, 3 * s}, {3 * s, s}));
  CHECK(count(filled({s, s}, {3 * s, s}, {s, 3 * s})) == 6);
  CHECK(count(filled({s, s}, {s, s}, {s, s})) == 1);
  CHECK(count(filled({s, s}, {5 * s, 5 * s}, {3 * s, 3 * s})) == 5);
  CHECK(count(filled({s + 1, s + 1}, {2 * s - 1, s + 1}, {s + 1, 2 * s - 1})) == 0);
  CHECK(count(filled({0, 0}, {63 * s, 0}, {0, 63 * s})) == 64 * 65 / 2);
}

TEST_CASE("silhouette: orientation and order do not matter") {
  Random random(4);
  const Shape egg = make_ellipsoid({0.3, 1, 0.02}, 3);
  for (const Shape& shape : {egg, without_some_faces(egg), make_soup(random, 50, 60)}) {
    const NormalizedShape s = normalized_shape(shape);
    for (int i = 0; i < 5; ++i) {
      const ViewPlane plane = random_plane(random);
      const BitImage mask = draw_silhouette(s, plane, 128);
      const Shape other = reordered(shape, random);
      CHECK(draw_silhouette(apply(normalize(shape), other), plane, 128) == mask);
      CHECK(draw_silhouette(apply(normalize(shape), unwelded(shape)), plane, 128) == mask);
      // Two faces at every edge of a doubled open shape: its holes are no longer filled.
      if (s.closed)
        CHECK(draw_silhouette(apply(normalize(shape), doubled(shape)), plane, 128) == mask);
    }
  }
}

TEST_CASE("trace: a needle thinner than a pixel leaves a line from end to end") {
  Random random(5);
  for (const int n : {64, 256}) {
    const int s = subpixels_of(n);
    for (int i = 0; i < 100; ++i) {
      SnappedPoints points = random_points(random, n, 3, 16 * s);
      const int wide = static_cast<int>(random.below(4));  // under a thirtieth of a pixel
      points.set(2, std::min(points.x(0) + wide, (n - 1) * s),
                 std::min(points.y(0) + wide, (n - 1) * s));
      const auto triangles = in_threes(3);
      BitImage mask = fill_triangles(points, triangles, n);
      const bool is_all_trace = count(mask) == 0;
      trace_thin_triangles(mask, points, triangles, n);
      INFO("side " << n << ", needle " << i);
      const auto pixel = [s](int c) { return (c + s / 2) / s; };
      const int x = pixel(points.x(0)), y = pixel(points.y(0));
      BitImage ends(n, n);
      ends.set(x, y);
      ends.set(pixel(points.x(1)), pixel(points.y(1)));
      // Beside a pixel that the needle fills by chance nothing is drawn: a gap of a pixel.
      const BitImage closed = is_all_trace ? mask : dilate(mask, 1.5);
      CHECK(contains_all(closed, ends));
      CHECK(reached_from(closed, x, y) == count(closed));
      CHECK(count(mask) <= 70);
    }
  }
}

TEST_CASE("trace: a fat shape is not thickened, also by its slivers") {
  Random random(6);
  const Shape egg = make_ellipsoid({0.5, 1, 0.6}, scaled(4, 3));
  const NormalizedShape s = normalized_shape(egg);
  for (const int n : {64, 100, 256}) {
    for (int i = 0; i < 10; ++i) {
      const SnappedPoints points = snap(s, random_plane(random), n);
      const BitImage mask = fill_triangles(points, s.triangles, n);
      BitImage traced = mask;
      trace_thin_triangles(traced, points, s.triangles, n);
      CHECK(traced == mask);
    }
  }
}

TEST_CASE("trace: adds to the mask only what is far from it, and nothing for fat triangles") {
  constexpr int kSide = 64;
  const int s = subpixels_of(kSide);
  // A fat triangle, and a needle that runs from its middle far out of it.
  const SnappedPoints points = lattice_points({{5 * s, 5 * s},
                                               {30 * s, 5 * s},
                                               {5 * s, 30 * s},
                                               {10 * s, 10 * s + s / 2},
                                               {50 * s, 40 * s + s / 2},
                                               {50 * s, 40 * s + s / 2 + 1}});
  const auto triangles = in_threes(6);
  const BitImage body = fill_triangles(points, {triangles.data(), 1}, kSide);
  BitImage mask = fill_triangles(points, triangles, kSide);
  const BitImage filled = mask;
  trace_thin_triangles(mask, points, triangles, kSide);
  CHECK(contains_all(mask, filled));
  CHECK(mask(50, 41));
  const BitImage closed = dilate(mask, 1.5);
  CHECK(reached_from(closed, 5, 5) == count(closed));
  const BitImage near = dilate(body, 1.5);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (near(x, y)) CHECK(mask(x, y) == filled(x, y));
  // The mask alone decides: without it, the outline of a fat triangle is still not drawn.
  BitImage empty(kSide, kSide);
  trace_thin_triangles(empty, points, {triangles.data(), 1}, kSide);
  CHECK(count(empty) == 0);
}

TEST_CASE("holes: small ones are filled, large ones and the background are not") {
  BitImage mask = draw_box(200, 10, 10, 180, 180);
  const BitImage solid = mask;
  for (int y = 30; y < 37; ++y)
    for (int x = 30; x < 37; ++x) mask.clear(x, y);  // inscribed radius 3.5
  for (int y = 30; y < 37; ++y)
    for (int x = 60; x < 160; ++x) mask.clear(x, y);  // long, but as thin
  BitImage with_large = mask;
  for (int y = 80; y < 91; ++y)
    for (int x = 80; x < 91; ++x) with_large.clear(x, y);  // 5.5
  BitImage filled = with_large;
  fill_small_holes(filled, 4);
  CHECK(count(filled) == count(solid) - 121);
  CHECK_FALSE(filled(85, 85));
  CHECK_FALSE(filled(5, 5));
  filled = with_large;
  fill_small_holes(filled, 3.5);  // under it, not at it
  CHECK(filled == with_large);
  filled = with_large;
  fill_small_holes(filled, 6);
  CHECK(filled == solid);
  BitImage bay = solid;  // a notch open to the outside
  for (int x = 100; x < 190; ++x) bay.clear(x, 100);
  filled = bay;
  fill_small_holes(filled, 50);
  CHECK(filled == bay);
  BitImage cut_off = draw_box(40, 0, 0, 40, 40);  // background at the edge of the image
  cut_off.clear(0, 7);
  filled = cut_off;
  fill_small_holes(filled, 50);
  CHECK(filled == cut_off);
}

TEST_CASE("silhouette: holes of open shapes are filled, those of closed shapes are real") {
  // A frame of eight boxes around a hole, 3 % of the image wide.
  const auto frame_with_hole = [](bool is_open) {
    Shape shape;
    for (int i = 0; i < 9; ++i) {
      if (i == 4) continue;
      const auto half = [](int k) { return k == 1 ? 0.028 : 0.4; };
      const auto middle = [](int k) { return (k - 1) * 0.428; };
      const Vec3 origin{middle(i % 3), middle(i / 3), 0};
      const Shape box = make_box({half(i % 3), half(i / 3), 0.1});
      const auto first = static_cast<std::uint32_t>(shape.points.size());
      for (const Vec3& p : box.points) shape.points.push_back(p + origin);
      for (const Triangle& t : box.triangles)
        shape.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    if (is_open) shape.triangles.pop_back();
    return shape;
  };
  const ViewPlane plane{{1, 0, 0}, {0, 1, 0}};
  for (const bool is_open : {false, true}) {
    const Shape shape = frame_with_hole(is_open);
    const Normalization n{1, {}, {}, 1.2};
    const NormalizedShape s = apply(n, shape);
    REQUIRE(s.closed == !is_open);
    const BitImage mask = draw_silhouette(s, plane, 256);
    CHECK(mask(100, 100));
    CHECK(mask(127, 127) == is_open);
  }
}
