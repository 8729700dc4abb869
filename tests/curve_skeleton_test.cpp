#include <marrow/curve_skeleton.hpp>

#include "catch.hpp"

using namespace marrow;

namespace {

CurveSkeleton graph(std::size_t nodes, std::vector<CurveSkeleton::Edge> edges) {
  CurveSkeleton s;
  for (std::size_t i = 0; i < nodes; ++i) s.nodes.push_back({{double(i), 0, 0}, 1});
  s.edges = std::move(edges);
  return s;
}

}  // namespace

TEST_CASE("an empty skeleton has no parts", "[curve_skeleton]") {
  CHECK(component_count({}) == 0);
  CHECK(cycle_count({}) == 0);
  CHECK(branches({}).empty());
}

TEST_CASE("a Y has three leaves, one joint and three branches", "[curve_skeleton]") {
  const auto y = graph(7, {{0, 1}, {0, 3}, {0, 5}, {1, 2}, {3, 4}, {5, 6}});
  CHECK(component_count(y) == 1);
  CHECK(cycle_count(y) == 0);
  CHECK(leaf_count(y) == 3);
  CHECK(joint_count(y) == 1);
  REQUIRE(branches(y).size() == 3);
  for (const auto& b : branches(y)) CHECK(b.nodes.size() == 3);
  CHECK(total_length(y) == Approx(1 + 3 + 5 + 1 + 1 + 1));
}

TEST_CASE("a ring is one closed branch without leaves", "[curve_skeleton]") {
  const auto ring = graph(4, {{0, 1}, {0, 3}, {1, 2}, {2, 3}});
  CHECK(cycle_count(ring) == 1);
  CHECK(leaf_count(ring) == 0);
  REQUIRE(branches(ring).size() == 1);
  CHECK(branches(ring)[0].is_closed());
  CHECK(branches(ring)[0].nodes.size() == 5);
}

TEST_CASE("a branch between two joints is found once, wherever its edges stand",
          "[curve_skeleton]") {
  // Joints 4 and 5, joined through 0 - 1: none of the first edges touches a joint.
  const auto s = graph(10, {{0, 1}, {0, 4}, {1, 5}, {4, 6}, {4, 7}, {5, 8}, {5, 9}});
  REQUIRE(branches(s).size() == 5);
  CHECK(joint_count(s) == 2);
  CHECK(branches(s)[0].nodes == std::vector<NodeId>{4, 0, 1, 5});
}

TEST_CASE("an isolated node is a part without branches", "[curve_skeleton]") {
  const auto s = graph(3, {{0, 1}});
  CHECK(component_count(s) == 2);
  CHECK(branches(s).size() == 1);
}
