#include <marrow/extract.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "graphs.hpp"
#include "scale.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// A solid of revolution about z: radius and height from below to above; the ends lie on the axis.
Shape turned(const std::vector<std::pair<double, double>>& outline) {
  constexpr std::uint32_t kSides = 48;
  const auto rings = static_cast<std::uint32_t>(outline.size() - 2);
  Shape shape;
  shape.points.push_back({0, 0, outline.front().second});
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      const auto [radius, height] = outline[r];
      shape.points.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
    }
  shape.points.push_back({0, 0, outline.back().second});
  const auto at = [](std::uint32_t ring, std::uint32_t k) {
    return 1 + ring * kSides + k % kSides;
  };
  const auto last = static_cast<std::uint32_t>(shape.points.size() - 1);
  for (std::uint32_t k = 0; k < kSides; ++k) {
    shape.triangles.push_back({0, at(0, k + 1), at(0, k)});
    shape.triangles.push_back({last, at(rings - 1, k), at(rings - 1, k + 1)});
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      shape.triangles.push_back({at(r, k), at(r, k + 1), at(r + 1, k + 1)});
      shape.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r + 1, k)});
    }
  }
  return shape;
}

CurveSkeleton skeleton_of_shape(const Shape& shape, Refinement refinement = Refinement::Surface) {
  ExtractOptions options;
  options.grid_resolution = scaled(128, 96);
  options.refinement = refinement;
  return extract(shape, options);
}

/// How far the nodes are from the z axis, at most.
double widest(const CurveSkeleton& skeleton) {
  double most = 0;
  for (const auto& n : skeleton.nodes)
    most = std::max(most, std::hypot(n.position.x, n.position.y));
  return most;
}

}  // namespace

TEST_CASE("a rod with discs is a rod", "[sheet_leaves]") {
  const Shape table = turned({{0, 0}, {0.15, 0}, {0.15, 2}, {1, 2}, {1, 2.12}, {0, 2.12}});
  const Shape axle = turned({{0, 0},
                             {0.12, 0},
                             {0.12, 0.6},
                             {0.7, 0.6},
                             {0.7, 0.8},
                             {0.12, 0.8},
                             {0.12, 2.4},
                             {0.7, 2.4},
                             {0.7, 2.6},
                             {0.12, 2.6},
                             {0.12, 3.2},
                             {0, 3.2}});
  const Shape dumbbell = turned(
      {{0, 0}, {0.5, 0}, {0.5, 0.3}, {0.1, 0.3}, {0.1, 1.5}, {0.5, 1.5}, {0.5, 1.8}, {0, 1.8}});
  for (const Shape& shape : {table, axle, dumbbell}) {
    INFO(shape.points.size());
    for (const auto refinement : {Refinement::Surface, Refinement::Hull}) {
      const CurveSkeleton skeleton = skeleton_of_shape(shape, refinement);
      CHECK(leaf_count(skeleton) == 2);
      CHECK(joint_count(skeleton) == 0);
      CHECK(widest(skeleton) < 0.2);
    }
  }
}

TEST_CASE("a disc alone keeps a line", "[sheet_leaves]") {
  const CurveSkeleton skeleton = skeleton_of_shape(turned({{0, 0}, {1, 0}, {1, 0.15}, {0, 0.15}}));
  CHECK_FALSE(skeleton.edges.empty());
  CHECK(component_count(skeleton) == 1);
}

TEST_CASE("flat limbs are no rims, and end once", "[sheet_leaves]") {
  Shape cross = box({-1.2, -0.3, -0.05}, {1.2, 0.3, 0.05});
  add_box(cross, {-0.3, -1.2, -0.05}, {0.3, 1.2, 0.05});
  const CurveSkeleton skeleton = skeleton_of_shape(cross);
  CHECK(leaf_count(skeleton) == 4);
  CHECK(joint_count(skeleton) == 1);
  CHECK(leaf_count(skeleton_of_shape(box({0, 0, 0}, {3, 0.6, 0.1}))) == 2);
}

TEST_CASE("lobes with notches between them are limbs", "[sheet_leaves]") {
  // A flat flower.
  constexpr std::uint32_t kSides = 96;
  Shape flower;
  for (const double z : {-0.08, 0.08})
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      const double radius = 0.8 + 0.2 * std::cos(5 * angle);
      flower.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  flower.points.push_back({0, 0, -0.08});
  flower.points.push_back({0, 0, 0.08});
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const std::uint32_t next = (k + 1) % kSides;
    flower.triangles.push_back({k, next, kSides + next});
    flower.triangles.push_back({k, kSides + next, kSides + k});
    flower.triangles.push_back({2 * kSides, next, k});
    flower.triangles.push_back({2 * kSides + 1, kSides + k, kSides + next});
  }
  CHECK(leaf_count(skeleton_of_shape(flower)) == 5);
}
