#include <flat_mesh.hpp>
#include <polygonise.hpp>
#include <trig.hpp>
#include <tube.hpp>

#include <cmath>
#include <cstdint>

#include "catch.hpp"
#include "mesh_checks.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// A number in [0, 1) for every place of a grid.
double noise(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  std::uint64_t h = seed;
  for (const std::int64_t i : {x, y, z}) {
    h = (h ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15;
    h ^= h >> 29;
  }
  return static_cast<double>(h >> 11) * 0x1p-53;
}

/// Another value at every corner of the grid of cells of width 1, positive far off: every way in
/// which a surface can pass through a cell and its neighbours comes up.
std::shared_ptr<const Field> noise_field(std::uint64_t seed, double share_inside) {
  return make_field([=](const Vec3& p) {
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 12.5) return 1e-3;
    const auto at = [](double x) { return std::llround(x * 2); };
    return (noise(at(p.x), at(p.y), at(p.z), seed) - share_inside) * 1e-3;
  });
}

BoneGraph ball_bones(double radius, double flatness) {
  BoneGraph graph;
  const int joint = add_joint(graph, {-0.5, 0.1, 0.2});
  add_limb(graph, joint, {{{-0.5, 0.1, 0.2}, radius}, {{0.5, 0.1, 0.2}, radius}}, 0);
  graph.bones.back().flatness = flatness;
  graph.bones.back().flat_axis = {0, 0, 1};
  return graph;
}

}  // namespace

TEST_CASE("trig: agrees with the library") {
  for (int i = -2000; i <= 2000; ++i) {
    const double turns = i / 777.0;
    const SinCos at = sin_cos_of_turns(turns);
    CHECK(std::abs(at.sin - std::sin(turns * 2 * std::numbers::pi)) < 1e-14);
    CHECK(std::abs(at.cos - std::cos(turns * 2 * std::numbers::pi)) < 1e-14);
    const double back = turns_of(at.sin, at.cos);
    CHECK(std::abs(back - turns - std::round(back - turns)) < 1e-14);
  }
  CHECK(turns_of(0, 0) == 0);
  CHECK(turns_of(0, -2) == 0.5);
  CHECK(turns_of(-3, 0) == -0.25);
  CHECK(sin_cos_of_turns(0.25).cos == 0);
}

TEST_CASE("polygonise: whatever the values, the mesh is a closed manifold") {
  for (const double share_inside : {0.1, 0.3, 0.5, 0.7}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Shape shape =
          polygonise(*noise_field(seed, share_inside), {{-14, -14, -14}, {14, 14, 14}}, 1);
      const MeshFacts facts = facts_of(shape);
      INFO("share " << share_inside << ", seed " << seed);
      CHECK(shape.triangles.size() > 1000);
      CHECK(facts.boundary_edges == 0);
      CHECK(facts.bad_edges == 0);
      CHECK(facts.bad_points == 0);
    }
  }
}

TEST_CASE("polygonise: the points lie on the surface and the normals point out of it") {
  const BoneGraph graph = ball_bones(0.4, 1);
  const Shape shape = polygonise(*blended_field(graph), bounds(graph), 0.08);
  CHECK(facts_of(shape).is_closed_manifold());
  CHECK(facts_of(shape).euler == 2);
  for (const Vec3& p : shape.points) {
    CHECK(distance_to_segment(p, {-0.5, 0.1, 0.2}, {0.5, 0.1, 0.2}) ==
          Approx(0.4).epsilon(0).margin(1e-6));
  }
  const double exact = std::numbers::pi * 0.16 * (1 + 4.0 / 3 * 0.4);
  CHECK(volume_of(shape) == Approx(exact).epsilon(0.01));
}

TEST_CASE("polygonise: a flat limb has an elliptic section") {
  const BoneGraph graph = ball_bones(0.4, 2);
  const Shape shape = polygonise(*blended_field(graph), bounds(graph), 0.04);
  CHECK(facts_of(shape).euler == 2);
  for (const Vec3& p : shape.points) {
    if (std::abs(p.x) > 0.5) continue;
    const double y = (p.y - 0.1) / 0.4;
    const double z = (p.z - 0.2) / 0.2;
    CHECK(y * y + z * z == Approx(1).epsilon(0).margin(1e-5));
  }
}

TEST_CASE("blend: leaving out what is far does not change a bit") {
  BoneGraph graph;
  const int joint = add_joint(graph, {});
  for (int i = 0; i < 12; ++i) {
    const SinCos at = sin_cos_of_turns(i / 12.0);
    const Vec3 tip{2 * at.cos, 2 * at.sin, 0.3 * (i % 3)};
    add_limb(graph, joint, subdivided({{{}, 0.3}, {tip, 0.1}}, 0.1), 0.05 * (i % 4));
    graph.bones.back().flatness = 1 + i % 2;
  }
  const auto field = blended_field(graph);
  for (int i = 0; i < 300; ++i) {
    const auto dice = [i](int k) { return 5 * noise(i, k, 7, 1) - 2.5; };
    const Vec3 centre{dice(0), dice(1), dice(2) / 4};
    const double radius = 0.05 + noise(i, 3, 7, 1) / 4;
    const auto near = field->near(centre, radius);
    const FieldRange range = field->range(centre, radius);
    for (int j = 0; j < 20; ++j) {
      const auto share = [i, j](int k) { return 2 * noise(i, j, k, 2) - 1; };
      const Vec3 p = centre + Vec3{share(0), share(1), share(2)} * (radius / std::sqrt(3.0));
      CHECK(near->value(p) == field->value(p));
      CHECK(near->sample(p).value == field->value(p));
      CHECK(range.low <= field->value(p));
      CHECK(range.high >= field->value(p));
    }
  }
}

TEST_CASE("tube: every ball touches the surface, also where the radius changes") {
  const Curve cone{subdivided({{{0, 0, 0}, 0.5}, {{2, 0, 0}, 0.1}}, 0.05), false};
  const Shape shape = make_tube(cone, 96);
  CHECK(facts_of(shape).is_closed_manifold());
  CHECK(facts_of(shape).euler == 2);
  CHECK(volume_of(shape) > 0);
  for (const Ball& ball : cone.balls) {
    CHECK(distance_to_surface(shape, ball.centre) == Approx(ball.radius).epsilon(0.002));
  }
}

TEST_CASE("flat mesh: a disc of the right size, with normals along z") {
  const auto disc = make_field([](const Vec3& p) { return std::sqrt(p.x * p.x + p.y * p.y) - 1; });
  const Shape shape = fill_flat(*disc, {{-1, -1, 0}, {1, 1, 0}}, 0.1);
  const MeshFacts facts = facts_of(shape);
  CHECK(facts.euler == 1);
  CHECK(facts.bad_edges == 0);
  CHECK(facts.bad_points == 0);
  double area = 0;
  for (const Triangle& t : shape.triangles) {
    const auto& p = shape.points;
    const Vec3 normal = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    CHECK(normal.z > 0);
    area += normal.z / 2;
  }
  CHECK(area == Approx(std::numbers::pi).epsilon(0.01));
  for (const auto& [a, b] : boundary_of(shape))
    CHECK(length(a) == Approx(1).epsilon(0).margin(1e-3));
}
