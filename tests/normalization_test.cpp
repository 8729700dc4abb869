#include <marrow/error.hpp>
#include <marrow/normalization.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "eigen_detail.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

void check_is_right_handed(const Frame& f) {
  for (const Vec3& axis : {f.x, f.y, f.z}) CHECK(length(axis) == Approx(1).epsilon(1e-12));
  CHECK(distance(cross(f.x, f.y), f.z) < 1e-12);
  CHECK(distance(cross(f.y, f.z), f.x) < 1e-12);
}

/// How far two lines are from each other; they may point either way.
double angle_between_lines(const Vec3& a, const Vec3& b) { return length(cross(a, b)); }

/// Moments of the surface along the axes of `frame`, from many small pieces of every triangle.
struct SlowMoments {
  Vec3 second, mixed, third;  // mixed: yz, zx, xy
};

SlowMoments slow_moments(const Shape& shape, const Frame& frame) {
  constexpr int kCuts = 40;
  struct Piece {
    Vec3 p;
    double area;
  };
  std::vector<Piece> pieces;
  for (const Triangle& t : shape.triangles) {
    const Vec3 a = shape.points[t[0]], u = shape.points[t[1]] - a, v = shape.points[t[2]] - a;
    const double area = length(cross(u, v)) / (kCuts * kCuts);
    for (int i = 0; i < kCuts; ++i)
      for (int j = 0; i + j < kCuts; ++j) {
        pieces.push_back({a + u * ((i + 1 / 3.0) / kCuts) + v * ((j + 1 / 3.0) / kCuts), area});
        if (i + j + 1 < kCuts)
          pieces.push_back({a + u * ((i + 2 / 3.0) / kCuts) + v * ((j + 2 / 3.0) / kCuts), area});
      }
  }
  Vec3 mean;
  double total = 0;
  for (const Piece& piece : pieces) mean += piece.p * piece.area, total += piece.area;
  mean = mean / total;
  SlowMoments m;
  for (const auto& [p, area] : pieces) {
    const Vec3 q = to_frame(frame, p - mean);
    const double w = area / total;
    m.second += Vec3{q.x * q.x, q.y * q.y, q.z * q.z} * w;
    m.mixed += Vec3{q.y * q.z, q.z * q.x, q.x * q.y} * w;
    m.third += Vec3{q.x * q.x * q.x, q.y * q.y * q.y, q.z * q.z * q.z} * w;
  }
  return m;
}

/// A bar along y, whose section is a triangle with its tip towards x; the ends are alike.
Shape make_roof() {
  return {{{3, -4, 0}, {-1, -4, 1}, {-1, -4, -1}, {3, 4, 0}, {-1, 4, 1}, {-1, 4, -1}},
          {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
}

Shape lumps(std::uint64_t seed) {
  Random random(seed);
  return make_soup(random, 30, 25);
}

void check_is_same_shape(const NormalizedShape& a, const NormalizedShape& b) {
  CHECK(a.x == b.x);
  CHECK(a.y == b.y);
  CHECK(a.z == b.z);
  CHECK(a.triangles == b.triangles);
  CHECK(a.low == b.low);
  CHECK(a.high == b.high);
  CHECK(a.closed == b.closed);
  CHECK(a.oriented == b.oriented);
}

ErrorKind error_of(const Shape& shape) {
  try {
    normalize(shape);
  } catch (const Error& e) {
    CHECK(std::string(e.what()).find("; give") != std::string::npos);
    return e.kind();
  }
  FAIL("did not throw");
  return {};
}

}  // namespace

TEST_CASE("eigensystem: takes a matrix apart") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Frame f = random.frame();
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(800)) - 400);
    std::array<double, 3> values{random.unit(), random.unit(), random.unit()};
    if (i % 4 == 0) values[1] = values[0];
    const Vec3 rows[] = {f.x * values[0], f.y * values[1], f.z * values[2]};
    const auto entry = [&](double Vec3::*a, double Vec3::*b) {
      return scale * (rows[0].*a * f.x.*b + rows[1].*a * f.y.*b + rows[2].*a * f.z.*b);
    };
    const SymmetricMatrix m{entry(&Vec3::x, &Vec3::x), entry(&Vec3::y, &Vec3::y),
                            entry(&Vec3::z, &Vec3::z), entry(&Vec3::x, &Vec3::y),
                            entry(&Vec3::x, &Vec3::z), entry(&Vec3::y, &Vec3::z)};
    const Eigensystem e = eigensystem(m);
    std::sort(values.begin(), values.end(), std::greater<>());
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(e.values[k] / scale == Approx(values[k]).epsilon(0).margin(1e-12));
      const Vec3& v = e.vectors[k];
      const Vec3 image{m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
                       m.xz * v.x + m.yz * v.y + m.zz * v.z};
      CHECK(distance(image / scale, v * (e.values[k] / scale)) < 1e-12);
      CHECK(length(v) == Approx(1));
      CHECK(std::abs(dot(v, e.vectors[(k + 1) % 3])) < 1e-12);
    }
  }
  CHECK(eigensystem({}).vectors[1] == Vec3{0, 1, 0});
}

TEST_CASE("normalize: y is the longest axis, x the next, z the shortest") {
  Random random(2);
  for (const Shape& shape : {make_box({2, 3, 1}), make_ellipsoid({0.5, 0.8, 0.3}, 3)}) {
    for (int i = 0; i < 30; ++i) {
      const Frame f = random.frame();
      const Vec3 origin = random.vector() * 10;
      const Normalization n = normalize(moved(shape, f, origin));
      check_is_right_handed(n.axes);
      CHECK(angle_between_lines(n.axes.x, f.x) < 1e-4);
      CHECK(angle_between_lines(n.axes.y, f.y) < 1e-4);
      CHECK(angle_between_lines(n.axes.z, f.z) < 1e-4);
      CHECK(distance(n.center / n.prescale, origin) < 1e-3);
    }
  }
  const Normalization n = normalize(make_box({3, 1, 2}));
  CHECK(n.axes.y == Vec3{1, 0, 0});
  CHECK(n.axes.x == Vec3{0, 0, 1});
  CHECK(n.radius / n.prescale == Approx(std::sqrt(14)));
}

TEST_CASE("normalize: the axes are those of the surface, the signs those of its third moments") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Shape shape = lumps(seed);
    const Normalization n = normalize(shape);
    const SlowMoments m = slow_moments(shape, n.axes);
    INFO("seed " << seed);
    check_is_right_handed(n.axes);
    CHECK(m.second.y > m.second.x);
    CHECK(m.second.x > m.second.z);
    for (const double mixed : {m.mixed.x, m.mixed.y, m.mixed.z}) CHECK(std::abs(mixed) < 2e-4);
    CHECK(m.third.x > 0);
    CHECK(m.third.y > 0);
  }
}

TEST_CASE("normalize: where the third moment vanishes, the greatest component is positive") {
  const Normalization n = normalize(make_roof());
  CHECK(distance(n.axes.y, {0, 1, 0}) < 1e-12);
  CHECK(distance(n.axes.x, {1, 0, 0}) < 1e-6);
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Frame f = random.frame();
    const Normalization turned = normalize(moved(make_roof(), f));
    CHECK(distance(turned.axes.x, f.x) < 1e-4);  // towards the tip of the section
    const Vec3 y = turned.axes.y;
    CHECK(angle_between_lines(y, f.y) < 1e-4);
    CHECK(std::max({y.x, y.y, y.z}) >= std::max({-y.x, -y.y, -y.z}));
  }
}

TEST_CASE("normalize: where moments coincide, the axes of the input decide") {
  CHECK(normalize(make_box({1, 1, 1})).axes == Frame{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}});
  CHECK(normalize(make_ellipsoid({2, 2, 2}, 2)).axes == Frame{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}});
  const Frame rod = normalize(make_box({1, 1, 4})).axes;
  CHECK(distance(rod.y, {0, 0, 1}) < 1e-9);
  CHECK(distance(rod.x, {1, 0, 0}) < 1e-9);
  const Frame plate = normalize(make_box({4, 1, 4})).axes;
  CHECK(distance(plate.y, {1, 0, 0}) < 1e-9);
  CHECK(distance(plate.x, {0, 0, 1}) < 1e-9);
  // Almost a tie: what a file's last digit says does not turn the axes.
  CHECK(distance(normalize(make_box({1, 1 + 2e-5, 4})).axes.x, {1, 0, 0}) < 1e-9);
  CHECK(distance(normalize(make_box({1 + 2e-5, 1, 4})).axes.x, {1, 0, 0}) < 1e-9);
}

TEST_CASE("normalize: the box is in the middle and the sphere has radius 1") {
  Random random(4);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Shape shape = moved(lumps(seed), random.frame(), random.vector() * 4, 3);
    const Normalization n = normalize(shape);
    const NormalizedShape s = apply(n, shape);
    CHECK(distance(s.low + s.high, {}) < 1e-12);
    double farthest = 0;
    Vec3 low, high;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const Vec3 p{s.x[i], s.y[i], s.z[i]};
      farthest = std::max(farthest, length(p));
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    CHECK(farthest == Approx(1).epsilon(1e-6));
    CHECK(distance(low, s.low) < 1e-6);
    CHECK(distance(high, s.high) < 1e-6);
    for (const Vec3& p : shape.points) CHECK(distance(n.to_input(n.to_normalized(p)), p) < 1e-12);
    CHECK(n.length_to_input(1) ==
          Approx(distance(n.to_input({0, 0, 0}), n.to_input({0, 0.6, 0.8}))).epsilon(1e-12));
  }
}

TEST_CASE("normalize: order of points, faces and corners changes nothing") {
  Random random(5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Shape shape = seed == 1 ? make_box({1, 1, 1}) : lumps(seed);
    const Normalization n = normalize(shape);
    for (int i = 0; i < 5; ++i) CHECK(normalize(reordered(shape, random)) == n);
    CHECK(normalize(unwelded(shape)) == n);
    CHECK(normalize(flipped(shape)) == n);
    CHECK(normalize(doubled(shape)) == n);
  }
}

TEST_CASE("normalize: unused points never count") {
  const Shape shape = lumps(6);
  Shape more = shape;
  more.points.insert(more.points.begin(), {1e200, -7, 3});
  more.points.push_back({-50, 50, 1e-300});
  for (Triangle& t : more.triangles)
    for (auto& i : t) ++i;
  CHECK(normalize(more) == normalize(shape));
  const NormalizedShape a = apply(normalize(shape), shape), b = apply(normalize(more), more);
  check_is_same_shape(a, b);
  for (const Triangle& t : b.triangles)
    for (const auto i : t) CHECK(i < b.x.size());
}

TEST_CASE("normalize: cutting the faces of a part finer does not move the frame") {
  const Shape coarse = make_roof();
  Shape fine = coarse;  // one face in many
  for (int i = 0; i < 100; ++i) {
    const Triangle t = fine.triangles.front();
    const auto middle = static_cast<std::uint32_t>(fine.points.size());
    fine.points.push_back((fine.points[t[1]] + fine.points[t[2]]) * 0.5);
    fine.triangles.erase(fine.triangles.begin());
    fine.triangles.insert(fine.triangles.end(), {{t[0], t[1], middle}, {t[0], middle, t[2]}});
  }
  CHECK(distance(normalize(fine).axes.x, normalize(coarse).axes.x) < 1e-4);
  CHECK(distance(normalize(fine).axes.y, normalize(coarse).axes.y) < 1e-4);
}

TEST_CASE("normalize: any size") {
  const Shape shape = lumps(7);
  const Normalization n = normalize(shape);
  for (const int power : {-996, -400, -1, 1, 400, 996}) {
    const Normalization scaled = normalize(moved(shape, {}, {}, std::ldexp(1.0, power)));
    CHECK(scaled.axes == n.axes);
    CHECK(scaled.radius == n.radius);
    CHECK(scaled.center == n.center);
    CHECK(scaled.prescale == std::ldexp(n.prescale, -power));
  }
  for (const double scale : {1e-307, 1e-300, 1e-30, 3e-5, 1e7, 1e37, 1e300, 1e308}) {
    const Shape large = moved(shape, {}, {}, scale);
    const Normalization scaled = normalize(large);
    INFO("scale " << scale);
    CHECK(distance(scaled.axes.y, n.axes.y) < 1e-4);
    CHECK(distance(scaled.axes.x, n.axes.x) < 1e-4);
    for (std::size_t i = 0; i < large.points.size(); ++i) {
      const Vec3 q = scaled.to_normalized(large.points[i]);
      if (scale > 1e-305) CHECK(distance(scaled.to_input(q) / scale, shape.points[i]) < 1e-12);
      CHECK(distance(q, n.to_normalized(shape.points[i])) < 1e-3);
    }
  }
}

TEST_CASE("normalize: far from the origin") {
  const Shape shape = lumps(8);
  const Normalization n = normalize(shape);
  for (const double far : {1e2, 1e5, 1e8}) {
    const Normalization there = normalize(moved(shape, {}, {far, -2 * far, far / 3}));
    INFO("at " << far);
    CHECK(distance(there.axes.y, n.axes.y) < 1e-4);
    CHECK(distance(there.axes.x, n.axes.x) < 1e-4);
    CHECK(there.radius / there.prescale == Approx(n.radius / n.prescale).epsilon(1e-4));
  }
}

TEST_CASE("normalize: a flat shape, and one of needles only") {
  const Frame flat = normalize(make_box({1, 3, 0})).axes;
  CHECK(distance(flat.y, {0, 1, 0}) < 1e-9);
  CHECK(distance(flat.x, {1, 0, 0}) < 1e-9);
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    const Vec3 along = i == 0 ? Vec3{1, 0, 0} : i == 1 ? Vec3{0, 0, -1} : random.frame().z;
    Shape needle;
    for (int k = 0; k < 12; ++k) needle.points.push_back(along * random.between(-2, 5));
    for (std::uint32_t k = 0; k < 10; ++k) needle.triangles.push_back({k, k + 1, k + 2});
    const Normalization n = normalize(needle);
    check_is_right_handed(n.axes);
    CHECK(angle_between_lines(n.axes.y, along) < 1e-4);
    CHECK(normalize(reordered(needle, random)) == n);
    const NormalizedShape s = apply(n, needle);
    CHECK(std::abs(s.high.y - 1) < 1e-4);
    CHECK(s.high.x < 1e-3);
  }
  const Shape segment{{{1, 1, 1}, {2, 2, 2}}, {{0, 1, 1}}};
  CHECK(angle_between_lines(normalize(segment).axes.y, normalized({1, 1, 1})) < 1e-6);
}

TEST_CASE("normalize: nothing to normalise") {
  CHECK(error_of({}) == ErrorKind::Empty);
  CHECK(error_of({{{1, 2, 3}}, {}}) == ErrorKind::Empty);
  CHECK(error_of({{{1, 2, 3}, {1, 2, 3}}, {}}) == ErrorKind::Empty);
  CHECK(error_of({{{0, 0, 0}, {4, 5, 6}}, {{0, 0, 0}}}) == ErrorKind::Empty);
  CHECK(error_of({{{7, 7, 7}, {7, 7, 7}, {7, 7, 7}}, {{0, 1, 2}}}) == ErrorKind::Empty);
  const double next = std::nextafter(7.0, 8.0);
  CHECK(error_of({{{7, 7, 7}, {next, 7, 7}, {7, next, 7}}, {{0, 1, 2}}}) == ErrorKind::Empty);
}

TEST_CASE("apply: tells closed and oriented shapes") {
  Random random(10);
  const auto check = [](const Shape& shape, bool closed, bool oriented) {
    const NormalizedShape s = apply(normalize(shape), shape);
    CHECK(s.closed == closed);
    CHECK(s.oriented == oriented);
  };
  for (const Shape& shape : {make_box({1, 2, 3}), make_ellipsoid({1, 2, 3}, 2)}) {
    check(shape, true, true);
    check(flipped(shape), true, true);
    check(unwelded(shape), true, true);
    check(doubled(shape), true, true);
    check(reordered(shape, random, false), true, true);
    Shape one_flipped = shape;
    std::swap(one_flipped.triangles[3][0], one_flipped.triangles[3][1]);
    check(one_flipped, true, false);
    Shape open = shape;
    open.triangles.pop_back();
    check(open, false, false);
    check(unwelded(open), false, false);
    check(flipped(open), false, false);
    Shape fin = shape;  // a third face at one edge
    const Triangle t = shape.triangles[0];
    fin.points.push_back({5, 5, 5});
    fin.triangles.push_back({t[0], t[1], static_cast<std::uint32_t>(shape.points.size())});
    check(fin, false, false);
    Shape with_flat = shape;  // a face between two corners at one place
    with_flat.triangles.push_back({t[0], t[0], t[1]});
    check(with_flat, true, true);
  }
  Shape signed_zeros = unwelded(make_box({1, 1, 1}));
  for (Vec3& p : signed_zeros.points) p.x = p.x < 0 ? -1 : 0;
  for (std::size_t i = 0; i < signed_zeros.points.size(); i += 2)
    if (signed_zeros.points[i].x == 0) signed_zeros.points[i].x = -0.0;
  check(signed_zeros, true, true);
  check(lumps(1), false, false);
}
