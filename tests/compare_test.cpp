#include <marrow/compare.hpp>
#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "mesh_checks.hpp"
#include "random_skeleton.hpp"

using namespace marrow;

namespace {

/// From the point to the nearest of all lines and lone nodes, one after the other.
double plain_distance(const CurveSkeleton& s, const Vec3& p) {
  double nearest = HUGE_VAL;
  for (const auto& [a, b] : s.edges)
    nearest =
        std::min(nearest, test::distance_to_segment(p, s.nodes[a].position, s.nodes[b].position));
  const auto degree = degrees(s);
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) nearest = std::min(nearest, distance(p, s.nodes[n].position));
  return nearest;
}

}  // namespace

TEST_CASE("a skeleton is where it is", "[compare]") {
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    const CurveSkeleton s = test::random_skeleton(seed);
    const Comparison same = compare(s, s);
    CHECK(same.hausdorff() <= 1e-12 * same.diagonal);
    CHECK(same.mean() <= 1e-12 * same.diagonal);
  }
}

TEST_CASE("two lines are as far apart as they are", "[compare]") {
  const CurveSkeleton first{{{{0, 0, 0}, 1}, {{3, 4, 0}, 1}}, {{0, 1}}};
  const CurveSkeleton beside{{{{0, 0, 2}, 1}, {{3, 4, 2}, 1}}, {{0, 1}}};
  const Comparison parallel = compare(first, beside);
  CHECK(parallel.diagonal == 5);
  CHECK(parallel.there.mean == Approx(2));
  CHECK(parallel.back.most == Approx(2));
  // Half of it: what is missing is seen from one side only.
  const CurveSkeleton half{{{{0, 0, 0}, 1}, {{1.5, 2, 0}, 1}}, {{0, 1}}};
  const Comparison missing = compare(first, half);
  CHECK(missing.there.most == Approx(2.5));
  CHECK(missing.there.mean == Approx(2.5 / 4).epsilon(1e-3));
  CHECK(missing.back.most == Approx(0).margin(1e-12));
  CHECK(missing.hausdorff() == Approx(2.5));
}

TEST_CASE("lone nodes are of the skeleton", "[compare]") {
  const CurveSkeleton one{{{{0, 0, 0}, 1}}, {}}, other{{{{0, 3, 4}, 1}}, {}};
  CHECK(compare(one, other).there.mean == 5);
  CHECK(compare(one, other).back.most == 5);
  CHECK(compare(one, one).hausdorff() == 0);
  CHECK_THROWS_AS(compare(one, {}), Error);
  CHECK_THROWS_AS(compare({}, one), Error);
  CHECK_THROWS_AS(compare(one, one, 0), Error);
}

TEST_CASE("the nearest line is found as by looking at all", "[compare]") {
  for (std::uint64_t seed = 2; seed < 30; ++seed) {
    const CurveSkeleton a = test::random_skeleton(seed), b = test::random_skeleton(seed + 1000);
    INFO("seed " << seed);
    double most = 0;
    for (const auto& node : a.nodes) most = std::max(most, plain_distance(b, node.position));
    // The farthest point may be within an edge.
    REQUIRE(compare(a, b).there.most >= most * (1 - 1e-9));
    double between = most;
    for (const auto& [i, j] : a.edges)
      for (int k = 0; k <= 500; ++k) {
        const Vec3 p =
            a.nodes[i].position + (a.nodes[j].position - a.nodes[i].position) * (k / 500.0);
        between = std::max(between, plain_distance(b, p));
      }
    REQUIRE(compare(a, b).there.most == Approx(between).epsilon(1e-2));
  }
}

TEST_CASE("very small and very large skeletons are compared", "[compare]") {
  for (const double scale : {1e-200, 1e200}) {
    const CurveSkeleton a{{{{0, 0, 0}, 1}, {{scale, 0, 0}, 1}}, {{0, 1}}};
    const CurveSkeleton b{{{{0, scale, 0}, 1}, {{scale, scale, 0}, 1}}, {{0, 1}}};
    CHECK(compare(a, b).hausdorff() / scale == Approx(1));
  }
}
