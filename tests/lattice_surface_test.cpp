#include <marrow/bounds.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "catch.hpp"
#include "closure_detail.hpp"
#include "lattice_surface_detail.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

using LatticePoint = std::array<std::int64_t, 3>;

/// The sums of LatticeSurface one triangle after the other, in 64-bit integers.
class PlainSurface {
 public:
  PlainSurface(const Shape& shape, const Vec3& center, double longest_side) : shape_(shape) {
    const double scale = (1 << 20) / longest_side;
    for (const Vec3& p : shape.points) {
      const Vec3 q = (p - center) * scale;
      points_.push_back({std::llrint(q.x), std::llrint(q.y), std::llrint(q.z)});
    }
    by_area_ = std::any_of(shape.triangles.begin(), shape.triangles.end(),
                           [&](const Triangle& t) { return area(t) > 0; });
  }

  Moments moments() const {
    Moments m;
    for (const Triangle& t : shape_.triangles) {
      const double w = weight(t);
      m.area += std::llrint(w * 0x1p10);
      for (std::size_t i = 0; i < 3; ++i)
        m.first[i] += std::llrint(w * static_cast<double>(sum(t, i)) * 0x1p-10);
      for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t u = i < 3 ? i : (i == 5 ? 1 : 0), v = i < 3 ? i : (i == 3 ? 1 : 2);
        std::int64_t product = sum(t, u) * sum(t, v);
        for (const auto p : t) product += points_[p][u] * points_[p][v];
        m.second[i] += std::llrint(w * static_cast<double>(product) * 0x1p-30);
      }
    }
    return m;
  }

  double third_moment(const Vec3& mean, const Vec3& axis) const {
    Int128 sum = 0, area_sum = 0;
    for (const Triangle& t : shape_.triangles) {
      std::array<double, 3> s;
      for (std::size_t k = 0; k < 3; ++k) s[k] = along(points_[t[k]], mean, axis);
      std::sort(s.begin(), s.end());
      const auto [a, b, c] = s;
      const double cubic = a * a * a + b * b * b + c * c * c + a * a * b + a * a * c + b * b * a +
                           b * b * c + c * c * a + c * c * b + a * b * c;
      sum += std::llrint(weight(t) * cubic * 0x1p-50);
      area_sum += std::llrint(weight(t) * 0x1p10);
    }
    return static_cast<double>(sum) * 0x1p60 / (10 * static_cast<double>(area_sum));
  }

 private:
  std::int64_t sum(const Triangle& t, std::size_t axis) const {
    return points_[t[0]][axis] + points_[t[1]][axis] + points_[t[2]][axis];
  }
  std::int64_t edge(const Triangle& t, std::size_t corner, std::size_t axis) const {
    return points_[t[(corner + 1) % 3]][axis] - points_[t[corner]][axis];
  }
  double area(const Triangle& t) const {
    double squares = 0;
    for (const std::size_t u : {1, 2, 0}) {
      const std::size_t v = (u + 1) % 3;
      const auto n =
          static_cast<double>(edge(t, 0, u) * -edge(t, 2, v) + edge(t, 0, v) * edge(t, 2, u));
      squares += n * n;
    }
    return std::sqrt(squares);
  }
  double weight(const Triangle& t) const {
    if (by_area_) return area(t);
    std::int64_t squares = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i) squares += edge(t, k, i) * edge(t, k, i);
    return std::sqrt(static_cast<double>(squares));
  }
  static double along(const LatticePoint& p, const Vec3& mean, const Vec3& axis) {
    const auto [x, y, z] = p;
    return dot(Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)} - mean,
               axis);
  }

  const Shape& shape_;
  std::vector<LatticePoint> points_;
  bool by_area_ = true;
};

void check_against_plain(const Shape& shape, const Frame& frame) {
  Bounds box;
  for (const Vec3& p : shape.points) box.add(p);
  const PlainSurface plain(shape, box.center(), box.longest_side());
  const LatticeSurface surface(shape, 1, box.center(), box.longest_side());
  const Moments expected = plain.moments();
  CHECK((surface.moments().area == expected.area));
  CHECK((surface.moments().first == expected.first));
  CHECK((surface.moments().second == expected.second));
  const Vec3 mean = expected.covariance().mean;
  const auto third = surface.third_moments(mean, {frame.x, frame.y});
  CHECK(third[0] == plain.third_moment(mean, frame.x));
  CHECK(third[1] == plain.third_moment(mean, frame.y));
}

/// Closed and oriented, by counting at every edge.
Closure plain_closure(const Shape& shape) {
  using Place = std::array<double, 3>;
  struct Count {
    int triangles = 0, turn = 0;
  };
  std::map<std::pair<Place, Place>, Count> edges;
  const auto place = [&](std::uint32_t i) {
    const Vec3& p = shape.points[i];
    return Place{p.x, p.y, p.z};
  };
  for (const Triangle& t : shape.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Place a = place(t[k]), b = place(t[(k + 1) % 3]);
      if (a == b) continue;
      Count& count = edges[{std::min(a, b), std::max(a, b)}];
      ++count.triangles;
      count.turn += a < b ? 1 : -1;
    }
  Closure closure{true, true};
  for (const auto& [ends, count] : edges) {
    closure.closed &= count.triangles % 2 == 0;
    closure.oriented &= count.triangles % 2 == 0 && count.turn == 0;
  }
  return closure;
}

void check_closure(const Shape& shape) {
  const Closure closure = closure_of(shape), expected = plain_closure(shape);
  CHECK(closure.closed == expected.closed);
  CHECK(closure.oriented == expected.oriented);
}

}  // namespace

TEST_CASE("lattice surface: moments are those of one triangle after the other") {
  Random random(11);
  // Triangles as large as the box, in blocks that are full, empty, and all but.
  for (const std::size_t n : {1u, 2u, 63u, 64u, 65u, 1000u})
    check_against_plain(make_soup(random, 50, n), random.frame());
  for (int levels = 0; levels < 6; ++levels) {
    Shape ball = moved(make_ellipsoid({1, 2, 0.5}, levels), random.frame(), random.vector());
    check_against_plain(ball, random.frame());
    // A few large ones among the small.
    const auto n = static_cast<std::uint32_t>(ball.points.size());
    for (int i = 0; i < 5; ++i)
      ball.triangles[random.below(static_cast<std::uint32_t>(ball.triangles.size()))] = {
          random.below(n), random.below(n), random.below(n)};
    check_against_plain(ball, random.frame());
  }
}

TEST_CASE("lattice surface: moments as great as they can be") {
  // Squares across the box at one end, and one at the other, far from the mean.
  Shape sheets;
  for (const double x : {0, 0, 0, 0, 1}) {
    const auto first = static_cast<std::uint32_t>(sheets.points.size());
    sheets.points.insert(sheets.points.end(), {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}, {x, 1, 1}});
    sheets.triangles.push_back({first, first + 1, first + 2});
    sheets.triangles.push_back({first + 1, first + 3, first + 2});
  }
  check_against_plain(sheets, {});
}

TEST_CASE("lattice surface: needles weigh by their edges") {
  Random random(12);
  Shape needles;
  for (int i = 0; i < 100; ++i) needles.points.push_back({random.unit(), 0, 0});
  for (int i = 0; i < 200; ++i)
    needles.triangles.push_back({random.below(100), random.below(100), random.below(100)});
  check_against_plain(needles, random.frame());
}

TEST_CASE("closure: closed and oriented as counted at every edge") {
  Random random(13);
  const Shape ball = make_ellipsoid({1, 1, 1}, 3);
  check_closure(ball);
  check_closure(unwelded(ball));
  check_closure(doubled(ball));
  check_closure(reordered(ball, random));
  check_closure(reordered(ball, random, false));
  for (int i = 0; i < 20; ++i) {
    Shape broken = unwelded(reordered(ball, random, i % 2 == 0));
    broken.triangles.resize(broken.triangles.size() - random.below(3));
    check_closure(broken);
    check_closure(make_soup(random, 6, 1 + random.below(30)));
  }
  // The same place on either side of zero.
  Shape box = unwelded(make_box({1, 1, 1}));
  for (Vec3& p : box.points) {
    p.x += 1;
    if (p.x == 0 && random.below(2) == 1) p.x = -0.0;
  }
  check_closure(box);
  CHECK(closure_of(box).oriented);
}
