#include <marrow/polygon.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace marrow;

namespace {

using Outline = std::vector<std::array<double, 2>>;

/// Numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state_ >> 33) % n);
  }
  double unit() { return below(1u << 30) / double(1u << 30); }

 private:
  std::uint64_t state_;
};

std::vector<Vec3> in_frame(const Outline& outline, const Frame& frame = {}, double scale = 1,
                           const Vec3& origin = {}) {
  std::vector<Vec3> corners;
  for (const auto& p : outline)
    corners.push_back(origin + from_frame(frame, {p[0] * scale, p[1] * scale, 0}));
  return corners;
}

double doubled_area(const std::array<double, 2>& a, const std::array<double, 2>& b, double x,
                    double y) {
  return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/// How often the closed line winds around the place.
int winding(const Outline& line, double x, double y) {
  int result = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto &a = line[i], &b = line[(i + 1) % line.size()];
    const bool up = a[1] <= y && b[1] > y, down = a[1] > y && b[1] <= y;
    if (up && doubled_area(a, b, x, y) > 0) ++result;
    if (down && doubled_area(a, b, x, y) < 0) --result;
  }
  return result;
}

std::vector<Outline> triangles_of(const PolygonCut& cut, std::vector<Vec3> points,
                                  const Frame& frame = {}, double scale = 1,
                                  const Vec3& origin = {}) {
  points.insert(points.end(), cut.extra_points.begin(), cut.extra_points.end());
  std::vector<Outline> result;
  for (const Triangle& t : cut.triangles) {
    Outline triangle;
    for (const auto i : t) {
      if (i >= points.size()) FAIL("a triangle names a point that is not there");
      const Vec3 p = to_frame(frame, points[i] - origin) / scale;
      triangle.push_back({p.x, p.y});
    }
    result.push_back(triangle);
  }
  return result;
}

double area_of(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    sum += doubled_area(outline[0], outline[i], outline[i + 1][0], outline[i + 1][1]) / 2;
  return sum;
}

double covered_area(const std::vector<Outline>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += std::abs(area_of(t));
  return sum;
}

/// Places where `triangles` and `outline` do not agree, of `count` random ones in its box.
int mismatches(const Outline& outline, const std::vector<Outline>& triangles, int count,
               Random& random) {
  auto low = outline[0], high = outline[0];
  for (const auto& p : outline)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  int wrong = 0;
  for (int i = 0; i < count; ++i) {
    const double x = low[0] + (high[0] - low[0]) * random.unit();
    const double y = low[1] + (high[1] - low[1]) * random.unit();
    const bool covered = std::any_of(triangles.begin(), triangles.end(),
                                     [&](const Outline& t) { return winding(t, x, y) != 0; });
    wrong += covered != (winding(outline, x, y) != 0);
  }
  return wrong;
}

void check_cover(const Outline& outline, int count = 400) {
  Random random(7);
  const auto corners = in_frame(outline);
  const auto cut = cut_polygon(corners);
  CHECK(mismatches(outline, triangles_of(cut, corners), count, random) == 0);
}

/// A simple polygon without crossings: it covers its area, and n corners give n - 2 triangles.
void check_simple(const Outline& outline) {
  const auto corners = in_frame(outline);
  const auto cut = cut_polygon(corners);
  CHECK(cut.extra_points.empty());
  CHECK(cut.triangles.size() == outline.size() - 2);
  const auto triangles = triangles_of(cut, corners);
  CHECK(covered_area(triangles) == Approx(std::abs(area_of(outline))).epsilon(1e-6));
  // They turn the way it turns.
  double sum = 0;
  for (const auto& t : triangles) sum += area_of(t);
  CHECK(sum == Approx(area_of(outline)).epsilon(1e-6));
}

/// A rectangle with `teeth` slits from above.
Outline comb(int teeth) {
  Outline outline{{0, 0}};
  outline.push_back({2.0 * teeth, 0});
  for (int i = teeth - 1; i >= 0; --i) {
    outline.push_back({2 * i + 2.0, 10});
    outline.push_back({2 * i + 1.0, 10 - 0.1 * (i % 7)});
    if (i > 0) outline.push_back({2 * i + 0.5, 1});
  }
  outline.push_back({0, 10});
  return outline;
}

/// A band wound around itself: its inner and its outer side, each of `n` corners.
Outline spiral(int n, double turns) {
  Outline outline;
  const auto at = [&](int i, double shift) {
    const double angle = 2 * 3.14159265358979 * turns * i / n;
    const double r = 1 + 4 * turns * i / n + shift;
    return std::array<double, 2>{r * std::cos(angle), r * std::sin(angle)};
  };
  for (int i = 0; i < n; ++i) outline.push_back(at(i, 0));
  for (int i = n - 1; i >= 0; --i) outline.push_back(at(i, 2));
  return outline;
}

Outline star(int corners, double inner) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * i / corners;
    const double r = i % 2 ? inner : 1;
    outline.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return outline;
}

const Frame kTilted{
    {2.0 / 3, 2.0 / 3, 1.0 / 3}, {-2.0 / 3, 1.0 / 3, 2.0 / 3}, {1.0 / 3, -2.0 / 3, 2.0 / 3}};

}  // namespace

TEST_CASE("polygons with fewer than three corners cover nothing", "[polygon]") {
  CHECK(cut_polygon({}).triangles.empty());
  CHECK(cut_polygon(in_frame({{0, 0}, {1, 0}})).triangles.empty());
}

TEST_CASE("convex polygons become fans of their corners in their order", "[polygon]") {
  const auto cut = cut_polygon(in_frame({{0, 0}, {2, 0}, {2, 1}, {0, 1}}));
  CHECK(cut.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  check_simple(star(1000, 1));
}

TEST_CASE("a concave quad is cut along its inner diagonal", "[polygon]") {
  for (std::size_t turn = 0; turn < 4; ++turn) {
    Outline arrow{{0, 0}, {3, -3}, {1, 0}, {3, 3}};
    std::rotate(arrow.begin(), arrow.begin() + std::ptrdiff_t(turn), arrow.end());
    check_simple(arrow);
    check_cover(arrow);
  }
}

TEST_CASE("concave polygons are covered, and nothing outside of them", "[polygon]") {
  const Outline l{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  const Outline c{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {4, 3}, {4, 4}, {0, 4}};
  for (Outline outline : {l, c, comb(5), star(10, 0.3), spiral(40, 2)}) {
    for (int i = 0; i < 2; ++i) {
      check_simple(outline);
      check_cover(outline);
      std::reverse(outline.begin(), outline.end());
    }
  }
}

TEST_CASE("large concave polygons are cut without trying all pairs", "[polygon]") {
  check_simple(comb(20'000));
  check_simple(star(60'000, 0.5));
  check_simple(spiral(30'000, 40));
}

TEST_CASE("a hole joined to the rim by a doubled edge stays a hole", "[polygon]") {
  const Outline keyhole{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0},
                        {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};
  check_cover(keyhole);
  const auto corners = in_frame(keyhole);
  CHECK(covered_area(triangles_of(cut_polygon(corners), corners)) == Approx(32));
}

TEST_CASE("polygons that touch or cross themselves cover what they wind around", "[polygon]") {
  const Outline bow_tie{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  const Outline lopsided_bow_tie{{0, 0}, {3, 2}, {3, 0}, {0, 1}, {-1, 0.5}};
  const Outline two_squares{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
  const Outline spike{{0, 0}, {4, 0}, {4, 2}, {6, 2}, {4, 2}, {4, 4}, {0, 4}};
  const Outline touching{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}};
  const Outline twice{{0, 0}, {4, 0}, {1, 1}, {0, 4}, {0, 0}, {4, 0}, {1, 1}, {0, 4}};
  // The edges at (0, 2) cancel, and it lies on others.
  const Outline cancelled{{3, 3}, {2, 1}, {2, 2}, {3, 2}, {1, 1}, {3, 2}, {0, 2}, {0, 0}};
  for (const auto& o : {bow_tie, lopsided_bow_tie, two_squares, spike, touching, twice, cancelled})
    check_cover(o, 2000);
  Outline pentagram;
  for (int i = 0; i < 5; ++i) pentagram.push_back(star(5, 1)[std::size_t(2 * i % 5)]);
  check_cover(pentagram, 2000);
  CHECK(cut_polygon(in_frame(bow_tie)).extra_points.size() == 1);
}

TEST_CASE("random outlines on a coarse grid cover what they wind around", "[polygon]") {
  // Few places for many corners: all the ways to touch, to overlap and to cross.
  Random random(20121);
  int wrong = 0;
  for (int round = 0; round < 3000; ++round) {
    Outline outline;
    const std::uint32_t n = 3 + random.below(12), side = 2 + random.below(6);
    for (std::uint32_t i = 0; i < n; ++i)
      outline.push_back({double(random.below(side)), double(random.below(side))});
    const auto corners = in_frame(outline);
    const auto triangles = triangles_of(cut_polygon(corners), corners);
    wrong += mismatches(outline, triangles, 40, random);
  }
  CHECK(wrong == 0);
}

TEST_CASE("random scribbles cover what they wind around", "[polygon]") {
  Random random(4);
  int wrong = 0;
  for (int round = 0; round < 60; ++round) {
    Outline outline;
    const std::uint32_t n = 5 + random.below(60);
    for (std::uint32_t i = 0; i < n; ++i) outline.push_back({random.unit(), random.unit()});
    const auto corners = in_frame(outline, kTilted);
    const auto triangles = triangles_of(cut_polygon(corners), corners, kTilted);
    wrong += mismatches(outline, triangles, 200, random);
  }
  CHECK(wrong == 0);
}

TEST_CASE("the plane, the place and the size of a polygon do not matter", "[polygon]") {
  Random random(1);
  const Outline c{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {4, 3}, {4, 4}, {0, 4}};
  for (const double scale : {1e-300, 1e-150, 1e-30, 1.0, 1e37, 1e150, 1e307}) {
    const auto corners = in_frame(c, kTilted, scale);
    const auto cut = cut_polygon(corners);
    CHECK(cut.triangles.size() == 6);
    CHECK(mismatches(c, triangles_of(cut, corners, kTilted, scale), 200, random) == 0);
  }
  const Vec3 far{1e6, -2e6, 3e6};
  const auto corners = in_frame(c, kTilted, 1e-3, far);
  CHECK(mismatches(c, triangles_of(cut_polygon(corners), corners, kTilted, 1e-3, far), 200,
                   random) <= 1);
}

TEST_CASE("a polygon that is not quite flat is covered as seen along its normal", "[polygon]") {
  Random random(3);
  const Outline outline = star(30, 0.4);
  auto corners = in_frame(outline, kTilted);
  for (Vec3& p : corners) p += kTilted.z * (0.02 * random.unit());
  const auto triangles = triangles_of(cut_polygon(corners), corners, kTilted);
  // The mean normal is not exactly that of the frame.
  CHECK(mismatches(outline, triangles, 2000, random) <= 10);
}

TEST_CASE("polygons without area give triangles that stay on them", "[polygon]") {
  const auto points_on_a_line = in_frame({{0, 0}, {3, 0}, {1, 0}, {5, 0}, {2, 0}}, kTilted);
  const auto one_point = in_frame({{1, 1}, {1, 1}, {1, 1}, {1, 1}});
  for (const auto& corners : {points_on_a_line, one_point}) {
    const auto cut = cut_polygon(corners);
    CHECK_FALSE(cut.triangles.empty());
    CHECK(cut.extra_points.empty());
  }
}

TEST_CASE("a scribble of very many crossings ends", "[polygon]") {
  Random random(9);
  Outline outline;
  for (int i = 0; i < 3000; ++i) outline.push_back({random.unit(), random.unit()});
  CHECK_FALSE(cut_polygon(in_frame(outline)).triangles.empty());
}

TEST_CASE("the largest finite corners do not overflow", "[polygon]") {
  const double m = std::numeric_limits<double>::max();
  const auto cut = cut_polygon(in_frame({{-m, -m}, {m, -m}, {m, m}, {0, 0}, {-m, m}}));
  CHECK(cut.triangles.size() == 3);
}
