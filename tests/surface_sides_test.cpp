#include <marrow/surface_sides.hpp>

#include "catch.hpp"
#include "graphs.hpp"
#include "mesh_checks.hpp"
#include "random.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

std::vector<PointSide> ask(const Shape& shape, const std::vector<Vec3>& points) {
  const NormalizedShape normalized_shape = as_normalized(shape);
  return SurfaceSides(normalized_shape).of(points);
}

Side side_of(const Shape& shape, const Vec3& p) { return ask(shape, {p})[0].side; }

/// Every point of a lattice over the normalised frame that is off the surface.
std::vector<Vec3> lattice_points_off(const Shape& shape, int steps) {
  std::vector<Vec3> points;
  for (int z = -steps; z <= steps; ++z)
    for (int y = -steps; y <= steps; ++y)
      for (int x = -steps; x <= steps; ++x) {
        const Vec3 p = Vec3{double(x), double(y), double(z)} / steps;
        if (distance_to_surface(shape, p) > 1e-6) points.push_back(p);
      }
  return points;
}

/// No point is unknown, and all are where the winding number says.
void check_against_winding_number(const Shape& shape, int steps) {
  const auto points = lattice_points_off(shape, steps);
  const auto sides = ask(shape, points);
  int inside = 0, wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool expected = winding_number(shape, points[i]) != 0;
    inside += expected;
    wrong += sides[i].side != (expected ? Side::Inside : Side::Outside);
  }
  CHECK(wrong == 0);
  CHECK(inside > 0);
  CHECK(inside < static_cast<int>(points.size()));
}

Shape octahedron(double radius) { return make_ellipsoid({radius, radius, radius}, 0); }

/// A ball whose corners lie on a coarse lattice.
Shape lattice_ball() {
  Shape shape = make_ellipsoid({0.75, 0.75, 0.75}, 2);
  for (auto& p : shape.points)
    p = {std::round(p.x * 8) / 8, std::round(p.y * 8) / 8, std::round(p.z * 8) / 8};
  return shape;
}

}  // namespace

TEST_CASE("in and out of a closed mesh", "[surface_sides]") {
  const Shape ball = make_ellipsoid({0.8, 0.8, 0.8}, 3);
  Random random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) points.push_back(random.vector());
  const auto sides = ask(ball, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double r = length(points[i]);
    if (r < 0.78) CHECK(sides[i].side == Side::Inside);
    if (r > 0.81) CHECK(sides[i].side == Side::Outside);
  }
}

TEST_CASE("lines through corners and edges cross a closed mesh once", "[surface_sides]") {
  // All six half lines from the middle run through corners, those of a box through diagonals.
  CHECK(side_of(octahedron(0.5), {0, 0, 0}) == Side::Inside);
  CHECK(side_of(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), {0, 0, 0}) == Side::Inside);
  check_against_winding_number(octahedron(0.5), 8);
  check_against_winding_number(box({-0.5, -0.25, -0.75}, {0.5, 0.5, 0.25}), 8);
}

TEST_CASE("all ties of a ball on a lattice", "[surface_sides]") {
  const Shape ball = lattice_ball();
  check_against_winding_number(ball, scaled(16, 8));
  check_against_winding_number(flipped(ball), scaled(16, 8));
}

TEST_CASE("every line along every axis crosses edges and corners once", "[surface_sides]") {
  // Two opposite faces of a cube as grids, and one of each other pair: only lines through the two
  // have a say, so that no other line can hide a crossing that is counted twice or never.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Shape shape;
    const auto point = [&](double along, double u, double v) {
      std::array<double, 3> p{};
      p[axis] = along, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
      shape.points.push_back({p[0], p[1], p[2]});
      return static_cast<std::uint32_t>(shape.points.size() - 1);
    };
    const auto quad = [&](std::array<std::uint32_t, 4> q, bool turned) {
      if (turned) q = {q[1], q[2], q[3], q[0]};
      shape.triangles.push_back({q[0], q[1], q[2]});
      shape.triangles.push_back({q[0], q[2], q[3]});
    };
    // The one face in finer cells than the other: else both count the same edge twice, and it
    // cancels.
    for (const auto& [h, cells] : {std::pair(-0.5, 1), {0.5, 4}})
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          const double d = 1.0 / cells, u = i * d - 0.5, v = j * d - 0.5;
          std::array<std::uint32_t, 4> q{point(h, u, v), point(h, u + d, v), point(h, u + d, v + d),
                                         point(h, u, v + d)};
          if (h < 0) std::swap(q[1], q[3]);
          quad(q, (i * j + i) % 3 == 0);
        }
    quad({point(-0.5, -0.5, -0.5), point(0.5, -0.5, -0.5), point(0.5, -0.5, 0.5),
          point(-0.5, -0.5, 0.5)},
         false);
    quad({point(-0.5, -0.5, -0.5), point(-0.5, 0.5, -0.5), point(0.5, 0.5, -0.5),
          point(0.5, -0.5, -0.5)},
         false);
    std::vector<Vec3> points;
    for (int z = -7; z <= 7; ++z)
      for (int y = -7; y <= 7; ++y)
        for (int x = -7; x <= 7; ++x) points.push_back(Vec3{double(x), double(y), double(z)} / 16);
    int wrong = 0;
    for (const auto& s : ask(shape, points)) wrong += s.side != Side::Inside;
    for (const auto& s : ask(flipped(shape), points)) wrong += s.side != Side::Inside;
    INFO("axis " << axis);
    CHECK(wrong == 0);
  }
}

TEST_CASE("a closed mesh may be inverted", "[surface_sides]") {
  const Shape cube = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const std::vector<Vec3> points{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.7}, {0.9, 0.9, 0.9}};
  const auto before = ask(cube, points);
  CHECK(before[0].side == Side::Inside);
  CHECK(before[1].side == Side::Outside);
  CHECK(before[2].side == Side::Outside);
  const auto after = ask(flipped(cube), points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(after[i].side == before[i].side);
    CHECK(after[i].clearance == before[i].clearance);
  }
}

TEST_CASE("where closed parts overlap it is inside", "[surface_sides]") {
  Shape two = box({-0.8, -0.3, -0.3}, {0.2, 0.3, 0.3});
  add_box(two, {-0.2, -0.2, -0.4}, {0.8, 0.2, 0.4});
  CHECK(side_of(two, {0.01, 0.02, 0.03}) == Side::Inside);    // both
  CHECK(side_of(two, {-0.61, 0.02, 0.03}) == Side::Inside);   // one
  CHECK(side_of(two, {0.61, 0.02, 0.03}) == Side::Inside);    // the other
  CHECK(side_of(two, {-0.61, 0.01, 0.35}) == Side::Outside);  // beside both
  check_against_winding_number(two, 10);
}

TEST_CASE("a cavity is outside", "[surface_sides]") {
  Shape shell = flipped(make_ellipsoid({0.4, 0.4, 0.4}, 2));
  const Shape outer = make_ellipsoid({0.8, 0.8, 0.8}, 2);
  const auto base = static_cast<std::uint32_t>(shell.points.size());
  shell.points.insert(shell.points.end(), outer.points.begin(), outer.points.end());
  for (const auto [a, b, c] : outer.triangles)
    shell.triangles.push_back({a + base, b + base, c + base});
  CHECK(side_of(shell, {0.01, 0.02, 0.03}) == Side::Outside);
  CHECK(side_of(shell, {0.6, 0.02, 0.03}) == Side::Inside);
  CHECK(side_of(shell, {0.9, 0.02, 0.03}) == Side::Outside);
}

TEST_CASE("lines through a hole of the surface have no say", "[surface_sides]") {
  const Vec3 in{0.1, 0.2, 0.15}, out{0.1, 0.2, 0.9};
  Shape cube = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  // Takes out what half of a face covers: the triangle that the line through `in` meets.
  const auto open = [&](std::size_t axis, double at) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto coordinates = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
    std::erase_if(cube.triangles, [&](const Triangle& t) {
      std::array<std::array<double, 3>, 3> c;
      for (std::size_t i = 0; i < 3; ++i) {
        c[i] = coordinates(cube.points[t[i]]);
        if (c[i][axis] != at) return false;
      }
      const auto p = coordinates(in);
      int left = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto &a = c[i], &b = c[(i + 1) % 3];
        left += (b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u]) > 0;
      }
      return left == 0 || left == 3;
    });
  };
  open(2, 0.5);
  CHECK(cube.triangles.size() == 11);
  CHECK(side_of(cube, in) == Side::Inside);  // x and y say so
  CHECK(side_of(cube, out) == Side::Outside);
  open(0, -0.5);
  CHECK(side_of(cube, in) == Side::Inside);  // y says so
  open(1, 0.5);
  CHECK(cube.triangles.size() == 9);
  CHECK(side_of(cube, in) == Side::Unknown);
}

TEST_CASE("a sheet has no inside", "[surface_sides]") {
  const Shape sheet{{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}}, {{0, 1, 2}}};
  const auto sides = ask(sheet, {{0, 0, 0.25}, {0, 0, -0.25}});
  for (const auto& s : sides) CHECK(s.side != Side::Inside);
}

TEST_CASE("clearance is the least distance along the six half lines", "[surface_sides]") {
  const Shape cube = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const auto sides =
      ask(cube, {{0, 0, 0}, {0.25, 0.1, 0}, {0.1, 0.2, -0.875}, {0.9, 0.9, 0.9}, {0.1, 0.2, 0.5}});
  CHECK(sides[0].clearance == Approx(0.5).margin(1e-5));
  CHECK(sides[1].clearance == Approx(0.25).margin(1e-5));
  CHECK(sides[2].clearance == Approx(0.375).margin(1e-5));
  CHECK(sides[3].clearance == 4);  // no line meets it
  CHECK(sides[4].clearance == Approx(0).margin(1e-5));
}

TEST_CASE("the order of triangles, corners and points is nothing", "[surface_sides]") {
  Shape ball = lattice_ball();
  const auto points = lattice_points_off(ball, 6);
  const auto before = ask(ball, points);
  std::reverse(ball.triangles.begin(), ball.triangles.end());
  for (auto& t : ball.triangles) t = {t[1], t[2], t[0]};
  const std::vector<Vec3> backwards(points.rbegin(), points.rend());
  const auto after = ask(ball, backwards);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(after[points.size() - 1 - i].side == before[i].side);
    CHECK(after[points.size() - 1 - i].clearance == Approx(before[i].clearance).margin(1e-9));
  }
  CHECK(ask(ball, {}).empty());
}

TEST_CASE("a point asked alone hears the same as among many", "[surface_sides]") {
  // Alone, nearly all triangles are passed over; among many hardly any. Fine and coarse meshes, and
  // a box whose large faces lie among small ones.
  for (const int levels : {1, 5, scaled(7, 5)}) {
    Shape shape = make_ellipsoid({0.3, 0.25, 0.2}, levels);
    add_box(shape, {-0.99, -0.04, -0.2}, {0.7, 0.3, 0.1});
    const NormalizedShape normalized_shape = as_normalized(shape);
    SurfaceSides surface(normalized_shape);
    Random random(levels < 4 ? 5 : 6);
    std::vector<Vec3> points;
    for (int i = 0; i < 3000; ++i) points.push_back(random.vector() * 0.35);
    const auto together = surface.of(points);
    int different = 0, inside = 0;
    for (std::size_t i = 0; i < points.size(); i += 10) {
      const PointSide alone = surface.of({&points[i], 1})[0];
      different += alone.side != together[i].side || alone.clearance != together[i].clearance;
      inside += alone.side == Side::Inside;
    }
    CHECK(different == 0);
    CHECK(inside > 0);
  }
}
