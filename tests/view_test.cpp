#include <marrow/view.hpp>

#include <algorithm>
#include <vector>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

std::vector<Vec3> all_vertices() {
  std::vector<Vec3> vertices;
  for (const Vec3& d : hemisphere_directions()) {
    vertices.push_back(d);
    vertices.push_back(-d);
  }
  return vertices;
}

void check_is_orthonormal(const Frame& f) {
  for (const Vec3& axis : {f.x, f.y, f.z}) CHECK(length(axis) == Approx(1).epsilon(1e-14));
  CHECK(distance(cross(f.x, f.y), f.z) < 1e-14);
  CHECK(distance(cross(f.y, f.z), f.x) < 1e-14);
}

}  // namespace

TEST_CASE("directions: 21 unit vectors, no two on one line") {
  const auto directions = hemisphere_directions();
  REQUIRE(directions.size() == 21);
  for (std::size_t i = 0; i < 21; ++i) {
    CHECK(length(directions[i]) == Approx(1).epsilon(1e-15));
    for (std::size_t j = 0; j < i; ++j) CHECK(length(cross(directions[i], directions[j])) > 0.5);
  }
}

TEST_CASE("directions: with their opposites the vertices of the subdivided icosahedron") {
  // From a corner of the icosahedron five middles of edges are 31.717 degrees away; from a middle
  // two corners at that angle, and four middles at 36 degrees.
  constexpr double kToMiddle = 0.85065080835203993, kBetweenMiddles = 0.80901699437494742;
  int corners = 0, middles = 0;
  for (const Vec3& v : all_vertices()) {
    std::vector<double> near;
    for (const Vec3& w : all_vertices())
      if (dot(v, w) > 0.6 && !(v == w)) near.push_back(dot(v, w));
    std::sort(near.begin(), near.end());
    std::vector<double> expected(5, kToMiddle);
    if (near.size() == 6) {
      expected.assign(4, kBetweenMiddles);
      expected.insert(expected.end(), 2, kToMiddle);
    }
    REQUIRE(near.size() == expected.size());
    for (std::size_t i = 0; i < near.size(); ++i)
      CHECK(near[i] == Approx(expected[i]).epsilon(1e-14));
    ++(near.size() == 5 ? corners : middles);
  }
  CHECK(corners == 12);
  CHECK(middles == 30);
}

TEST_CASE("directions: any place of the sphere is near one") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.frame().z;
    double nearest = -1;
    for (const Vec3& v : all_vertices()) nearest = std::max(nearest, dot(p, v));
    CHECK(nearest > 0.92);  // 22 degrees
  }
}

TEST_CASE("frame_along: orthonormal, right-handed, looking along the direction") {
  Random random(2);
  std::vector<Vec3> directions = all_vertices();
  for (int i = 0; i < 200; ++i) directions.push_back(random.frame().z * random.between(0.1, 9));
  for (const Vec3& d : directions) {
    const Frame f = frame_along(d);
    check_is_orthonormal(f);
    CHECK(distance(f.z, normalized(d)) < 1e-15);
    CHECK(frame_along(d) == f);
  }
}

TEST_CASE("frame: there and back") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Frame f = random.frame();
    const Vec3 p = random.vector() * 5;
    CHECK(distance(from_frame(f, to_frame(f, p)), p) < 1e-14);
    CHECK(to_frame(f, p).y == Approx(dot(f.y, p)));
  }
}

TEST_CASE("stereo pair: both images share their scanline axis") {
  const StereoPair pair{Random(4).frame()};
  CHECK(pair.front() == ViewPlane{pair.frame.x, pair.frame.y});
  CHECK(pair.side() == ViewPlane{pair.frame.z, pair.frame.y});
  CHECK(pair.front().v == pair.side().v);
}

TEST_CASE("pixel grid: the unit ball with three pixels of margin, there and back") {
  for (const int resolution : {64, 100, 255, 256, 1024}) {
    const PixelGrid grid{resolution};
    CHECK(grid.to_pixels(0) == 0.5 * (resolution - 1));
    CHECK(grid.to_pixels(-1) == Approx(2.5).epsilon(1e-12));  // pixels reach half a pixel farther
    CHECK(grid.to_pixels(1) == Approx(resolution - 1 - 2.5).epsilon(1e-12));
    CHECK(grid.to_pixels(grid.pixel()) - grid.to_pixels(0) == Approx(1).epsilon(1e-12));
    for (double x = -1; x <= 1; x += 0.07)
      CHECK(grid.to_length(grid.to_pixels(x)) == Approx(x).epsilon(0).margin(1e-14));
  }
}
