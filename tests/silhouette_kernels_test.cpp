// Every instruction set against the plain way: all pixels, on all kinds of shapes.
#include <marrow/silhouette.hpp>

#include <algorithm>
#include <bit>

#include "catch.hpp"
#include "fill_detail.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "scanline_fill.hpp"
#include "simd_targets.hpp"
#include "thin_triangles_detail.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr int kResolutions[] = {64, 100, 256, 1024};

ViewPlane random_plane(Random& random) {
  const Frame f = random.frame();
  return {f.x, f.y};
}

Shape without_some_faces(Shape shape, Random& random) {
  std::erase_if(shape.triangles, [&](const Triangle&) { return random.below(20) == 0; });
  return shape;
}

Shape with_some_flipped(Shape shape, Random& random) {
  for (Triangle& t : shape.triangles)
    if (random.below(2) == 0) std::swap(t[0], t[1]);
  return shape;
}

/// A closed disc of slivers: a fan about a point of its rim, above and below.
Shape make_fan(std::uint32_t corners, double thickness) {
  Shape s;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double t = 4.0 * i / corners - 2;  // a circle by halves of the tangent
    const double c = (1 - t * t) / (1 + t * t), d = 2 * t / (1 + t * t);
    s.points.push_back({c, d, thickness});
    s.points.push_back({c, d, -thickness});
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % corners);
    s.triangles.insert(s.triangles.end(), {{a, a + 1, b}, {b, a + 1, b + 1}});
    if (i != 0 && i + 1 != corners)
      s.triangles.insert(s.triangles.end(), {{0, a, b}, {1, b + 1, a + 1}});
  }
  return s;
}

struct Sample {
  const char* name;
  Shape shape;
};

std::vector<Sample> sample_shapes() {
  Random random(41);
  const Shape egg = make_ellipsoid({0.4, 1, 0.7}, scaled(5, 3));
  const Shape fine = make_ellipsoid({0.2, 1, 0.1}, scaled(6, 4));
  const Shape fan = make_fan(scaled(400, 100), 0.01);
  return {{"egg", egg},
          {"open egg", without_some_faces(egg, random)},
          {"flipped egg", flipped(egg)},
          {"egg with some faces flipped", with_some_flipped(egg, random)},
          {"egg of doubled faces", doubled(egg)},
          {"egg not welded", unwelded(egg)},
          {"egg in another order", reordered(egg, random, false)},
          {"fine ellipsoid", fine},
          {"open fine ellipsoid", without_some_faces(fine, random)},
          {"fan", fan},
          {"open fan", without_some_faces(fan, random)},
          {"rod", make_ellipsoid({0.001, 1, 0.001}, 4)},
          {"box", make_box({1, 2, 0.001})},
          {"plate", make_box({1, 0, 0.5})},
          {"soup", make_soup(random, 60, 40)},
          {"a triangle", {{{0, 0, 0}, {3, 1, 0}, {1, 2, 2}}, {{0, 1, 2}}}}};
}

std::size_t different(const BitImage& a, const BitImage& b) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < a.words().size(); ++i)
    sum += static_cast<std::size_t>(std::popcount(a.words()[i] ^ b.words()[i]));
  return sum;
}

/// Kernels may take a triangle twice.
std::vector<std::array<SnappedPoints::Packed, 3>> distinct(const PackedTriangles& triangles) {
  std::vector<std::array<SnappedPoints::Packed, 3>> all;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    all.push_back({triangles.a[i], triangles.b[i], triangles.c[i]});
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

TEST_CASE("kernels: the silhouettes of all kinds of shapes on every instruction set") {
  Random random(42);
  for (const auto& [name, shape] : sample_shapes()) {
    const NormalizedShape s = apply(normalize(shape), shape);
    for (const int n : kResolutions) {
      for (const ViewPlane& plane : {random_plane(random), ViewPlane{{1, 0, 0}, {0, 1, 0}}}) {
        const SnappedPoints points = snap(s, plane, n);
        const BitImage filled = scanline_fill(points, s.triangles, n);
        const BitImage traced = step_trace(filled, points, s.triangles, n);
        BitImage drawn = traced;
        if (!s.closed) fill_small_holes(drawn, 0.02 * n);
        on_each_simd_target([&, name = name] {
          INFO(name << ", side " << n);
          CHECK(different(fill_triangles(points, s.triangles, n), filled) == 0);
          BitImage mask = filled;
          trace_thin_triangles(mask, points, s.triangles, n);
          CHECK(different(mask, traced) == 0);
          CHECK(different(draw_silhouette(s, plane, n), drawn) == 0);
        });
      }
    }
  }
}

TEST_CASE("kernels: the counter-clockwise half of an oriented surface covers all of it") {
  Random random(43);
  for (const Shape& shape :
       {make_ellipsoid({0.4, 1, 0.7}, 4), make_ellipsoid({0.01, 1, 0.002}, 5), make_fan(100, 0.02),
        make_box({1, 1, 0.0001}), doubled(make_box({1, 0.5, 0.3}))}) {
    const NormalizedShape s = apply(normalize(shape), shape);
    REQUIRE(s.oriented);
    CHECK(facing_of(s) == Facing::CounterClockwise);
    for (const int n : kResolutions) {
      const SnappedPoints points = snap(s, random_plane(random), n);
      const BitImage expected = scanline_fill(points, s.triangles, n);
      on_each_simd_target([&] {
        const TriangleFill half = fill(points, s.triangles, Facing::CounterClockwise, n);
        CHECK(different(half.mask, expected) == 0);
      });
    }
  }
  const Shape open = make_soup(random, 20, 30);
  CHECK(facing_of(apply(normalize(open), open)) == Facing::Both);
}

TEST_CASE("kernels: large triangles are those of three pixel centres along a side") {
  Random random(44);
  for (const Shape& shape : {make_ellipsoid({0.4, 1, 0.7}, 3), make_fan(50, 0.1)}) {
    const NormalizedShape s = apply(normalize(shape), shape);
    for (const int n : kResolutions) {
      const SnappedPoints points = snap(s, random_plane(random), n);
      PackedTriangles expected;
      for (const Triangle& t : s.triangles) {
        const ScanTriangle scan(points, t, subpixels_of(n));
        if (scan.right - scan.left > 1 || scan.high - scan.low > 1) expected.push_back(points, t);
      }
      on_each_simd_target([&] {
        CHECK(distinct(fill(points, s.triangles, Facing::Both, n).large) == distinct(expected));
      });
    }
  }
}

TEST_CASE("kernels: any number of triangles") {
  Random random(45);
  const int n = 64, last = (n - 1) * subpixels_of(n);
  for (const std::size_t count :
       {0, 1, 2, 3, 7, 8, 9, 15, 16, 17, 63, 64, 65, 511, 512, 513, 1030}) {
    SnappedPoints points(3 * count);
    std::vector<Triangle> triangles;
    const auto near_by = [&](int c, int reach) {
      const auto off = static_cast<int>(random.below(static_cast<unsigned>(2 * reach + 1)));
      return std::clamp(c + off - reach, 0, last);
    };
    for (std::uint32_t i = 0; i < 3 * count; i += 3) {
      const int x = near_by(last / 2, last / 2), y = near_by(last / 2, last / 2);
      const int reach = static_cast<int>(random.below(1500)) + 1;
      for (std::uint32_t k = i; k < i + 3; ++k) points.set(k, near_by(x, reach), near_by(y, reach));
      triangles.push_back({i, i + 1, i + 2});
    }
    const BitImage filled = scanline_fill(points, triangles, n);
    const BitImage traced = step_trace(filled, points, triangles, n);
    on_each_simd_target([&] {
      INFO(count << " triangles");
      BitImage mask = fill_triangles(points, triangles, n);
      CHECK(different(mask, filled) == 0);
      trace_thin_triangles(mask, points, triangles, n);
      CHECK(different(mask, traced) == 0);
    });
  }
}

TEST_CASE("kernels: edges through pixel centres") {
  Random random(46);
  for (const int n : {64, 256, 1024}) {
    const int steps = subpixels_of(n), count = scaled(500, 50);
    SnappedPoints points(static_cast<std::size_t>(3 * count));
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < points.size(); i += 3) {
      for (std::uint32_t k = i; k < i + 3; ++k) {
        const auto coordinate = [&] {
          return static_cast<int>(random.below(static_cast<unsigned>(n))) * steps;
        };
        const int x = coordinate();
        points.set(k, x, coordinate());
      }
      triangles.push_back({i, i + 1, i + 2});
    }
    std::vector<BitImage> expected;
    for (const Triangle& t : triangles) expected.push_back(scanline_fill(points, {t}, n));
    on_each_simd_target([&] {
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < triangles.size(); ++i)
        wrong += different(fill_triangles(points, {&triangles[i], 1}, n), expected[i]);
      CHECK(wrong == 0);
    });
  }
}

TEST_CASE("kernels: triangles left out of the trace lie within the image") {
  Random random(47);
  constexpr int kSide = 100, kTriangles = 3000;
  const int steps = subpixels_of(kSide), shift = lattice_shift(kSide);
  BitImage image(kSide, kSide);  // a checkerboard of patches of many sizes, and one large one
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (y > 50 || ((x * x / 300 + y * y / 300) & 1) == 0) image.set(x, y);
  PackedTriangles triangles;
  for (int i = 0; i < kTriangles; ++i) {
    SnappedPoints corners(3);
    const int reach = static_cast<int>(random.below(18)) + 1;
    const auto place = [&](int least) {
      return least + static_cast<int>(random.below(static_cast<unsigned>(reach * steps)));
    };
    const int x = static_cast<int>(random.below(static_cast<unsigned>((kSide - 20) * steps)));
    const int y = static_cast<int>(random.below(static_cast<unsigned>((kSide - 20) * steps)));
    for (std::size_t k = 0; k < 3; ++k) corners.set(k, place(x), place(y));
    triangles.push_back(corners, {0, 1, 2});
  }
  const auto is_within = [&](std::size_t i, int side) {
    int left = kSide, right = 0, low = kSide, high = 0;
    for (const LatticePoint& p : corners_of(triangles, i)) {
      const int x = nearest_pixel(p.x, shift), y = nearest_pixel(p.y, shift);
      left = std::min(left, x), right = std::max(right, x);
      low = std::min(low, y), high = std::max(high, y);
    }
    if (right - left >= 2 * side || high - low >= 2 * side) return false;
    for (int y = low; y <= std::max(high, low + side - 1); ++y)
      for (int x = left; x <= std::max(right, left + side - 1); ++x)
        if (!image.contains(x, y) || !image(x, y)) return false;
    return true;
  };
  for (const int side : {4, 8}) {
    PackedTriangles expected;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (is_within(i, side)) continue;
      expected.a.push_back(triangles.a[i]);
      expected.b.push_back(triangles.b[i]);
      expected.c.push_back(triangles.c[i]);
    }
    REQUIRE(expected.size() < triangles.size() * 9 / 10);
    on_each_simd_target([&] {
      const PackedTriangles rest = not_within(squares_within(image, side), side, triangles, shift);
      CHECK(distinct(rest) == distinct(expected));
    });
  }
}
