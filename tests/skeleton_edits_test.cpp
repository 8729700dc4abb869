// Resampling, simplifying and pruning: what stays, what goes, and what the graph is afterwards.
#include <marrow/compare.hpp>
#include <marrow/error.hpp>
#include <marrow/prune.hpp>
#include <marrow/resample.hpp>
#include <marrow/simplify.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "random_skeleton.hpp"
#include "skeleton_faults.hpp"

using namespace marrow;
using test::random_skeleton;

namespace {

constexpr std::uint64_t kGraphs = 60;

void add_line(CurveSkeleton& s, NodeId from, const Vec3& to, int pieces, double radius) {
  const Vec3 begin = s.nodes[from].position;
  for (int i = 1; i <= pieces; ++i) {
    s.nodes.push_back({begin + (to - begin) * (double(i) / pieces), radius});
    const auto id = static_cast<NodeId>(s.nodes.size() - 1);
    s.edges.push_back({i == 1 ? from : id - 1, id});
  }
  std::sort(s.edges.begin(), s.edges.end());
}

CurveSkeleton straight_line(int pieces) {
  CurveSkeleton s{{{{0, 0, 0}, 1}}, {}};
  add_line(s, 0, {10, 0, 0}, pieces, 1);
  return s;
}

/// The graph without its nodes of degree two, as counts: what no edit may change.
std::vector<int> topology_of(const CurveSkeleton& s) {
  return {component_count(s), cycle_count(s), leaf_count(s), joint_count(s),
          static_cast<int>(branches(s).size())};
}

double longest_edge(const CurveSkeleton& s) {
  double longest = 0;
  for (const auto& [a, b] : s.edges)
    longest = std::max(longest, distance(s.nodes[a].position, s.nodes[b].position));
  return longest;
}

}  // namespace

TEST_CASE("a line is resampled in equal steps", "[edits]") {
  const CurveSkeleton s = resample(straight_line(7), 2.4);
  REQUIRE(s.nodes.size() == 5);
  CHECK(s.nodes[0].position == Vec3{0, 0, 0});
  CHECK(s.nodes[1].position == Vec3{10, 0, 0});
  for (std::size_t i = 2; i < 5; ++i) CHECK(s.nodes[i].position.x == Approx(2.5 * double(i - 1)));
  CHECK(s.edges == std::vector<CurveSkeleton::Edge>{{0, 2}, {1, 4}, {2, 3}, {3, 4}});
}

TEST_CASE("places and radii are interpolated", "[edits]") {
  const CurveSkeleton s{{{{0, 0, 0}, 1, 2}, {{4, 0, 0}, 3, 6}, {{4, 4, 0}, 3}}, {{0, 1}, {1, 2}}};
  const CurveSkeleton fine = resample(s, 1);
  REQUIRE(fine.nodes.size() == 9);
  const auto half = std::find_if(fine.nodes.begin(), fine.nodes.end(), [](const auto& n) {
    return n.position == Vec3{2, 0, 0};
  });
  REQUIRE(half != fine.nodes.end());
  CHECK(half->radius == 2);
  CHECK(half->section_radius == 4);
  // Where one end knows no section, nothing is known between.
  const auto corner = std::find_if(fine.nodes.begin(), fine.nodes.end(), [](const auto& n) {
    return n.position == Vec3{4, 2, 0};
  });
  REQUIRE(corner != fine.nodes.end());
  CHECK(corner->section_radius == 0);
}

TEST_CASE("steps by the radius are fine where a shape is thin", "[edits]") {
  CurveSkeleton s{{{{0, 0, 0}, 4}, {{40, 0, 0}, 0.4}}, {{0, 1}}};
  s = resample(s, 0.5);
  const CurveSkeleton by_radius = resample_by_radius(s, 1);
  for (const auto& [a, b] : by_radius.edges) {
    const auto &p = by_radius.nodes[a], &q = by_radius.nodes[b];
    CHECK(distance(p.position, q.position) / ((p.radius + q.radius) / 2) ==
          Approx(1).epsilon(0.15));
  }
}

TEST_CASE("resampling and simplifying leave the topology", "[edits]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed, seed % 2 == 1);
    INFO("seed " << seed);
    const double size = s.edges.empty() ? 1 : longest_edge(s);
    for (const double step : {0.1, 1.0, 1000.0}) {
      const CurveSkeleton even = resample(s, step * size);
      REQUIRE(test::fault_of(even) == "");
      REQUIRE(topology_of(even) == topology_of(s));
      REQUIRE(resample(s, step * size) == even);
      const CurveSkeleton by_radius = resample_by_radius(s, step);
      REQUIRE(test::fault_of(by_radius) == "");
      REQUIRE(topology_of(by_radius) == topology_of(s));
      const CurveSkeleton simple = simplify(even, step * size);
      REQUIRE(test::fault_of(simple) == "");
      REQUIRE(topology_of(simple) == topology_of(s));
    }
    if (s.edges.empty()) continue;
    const double step = longest_edge(s) / 50;
    const double apart = compare(s, resample(s, step)).hausdorff();
    REQUIRE(apart <= step);
  }
}

TEST_CASE("a straight line keeps its ends, a bend its corner", "[edits]") {
  CHECK(simplify(straight_line(50), 1e-9).nodes.size() == 2);
  CurveSkeleton bend = straight_line(10);
  add_line(bend, 10, {10, 5, 0}, 10, 1);
  const CurveSkeleton simple = simplify(bend, 1e-9);
  REQUIRE(simple.nodes.size() == 3);
  CHECK(simple.nodes[1].position == Vec3{10, 0, 0});
  CHECK(simplify(bend, 5).nodes.size() == 2);
  // A bulge is in the radii alone.
  CurveSkeleton bulge = straight_line(10);
  bulge.nodes[5].radius = 2;
  CHECK(simplify(bulge, 0.5).nodes.size() > 2);
  CHECK(simplify(bulge, 1).nodes.size() == 2);
}

TEST_CASE("a simplified skeleton is within the tolerance", "[edits]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed);
    if (s.edges.empty()) continue;
    const double tolerance = longest_edge(s) / 4;
    const CurveSkeleton simple = simplify(s, tolerance);
    INFO("seed " << seed);
    REQUIRE(compare(s, simple).there.most <= tolerance * (1 + 1e-9));
    for (const auto& node : simple.nodes)
      REQUIRE(std::find(s.nodes.begin(), s.nodes.end(), node) != s.nodes.end());
  }
}

TEST_CASE("a cycle keeps three nodes", "[edits]") {
  CurveSkeleton ring{{{{0, 0, 0}, 1}}, {}};
  add_line(ring, 0, {1, 0, 0}, 5, 1);
  add_line(ring, 5, {1, 1, 0}, 5, 1);
  add_line(ring, 10, {0, 0.1, 0}, 5, 1);
  ring.edges.push_back({0, 15});
  std::sort(ring.edges.begin(), ring.edges.end());
  CHECK(simplify(ring, 100).nodes.size() == 3);
  CHECK(cycle_count(simplify(ring, 100)) == 1);
  CHECK(resample(ring, 100).nodes.size() == 3);
  CHECK(cycle_count(resample(ring, 100)) == 1);
}

TEST_CASE("short end branches go, the shortest first", "[edits]") {
  // A trunk of length 10 with a twig of 1 at one third, and a fork of 2 and 3 at the end.
  CurveSkeleton s = straight_line(3);
  add_line(s, 1, {10.0 / 3, 1, 0}, 2, 0.5);
  add_line(s, 3, {10, 2, 0}, 2, 0.5);
  add_line(s, 3, {10, 0, 3}, 2, 0.5);
  REQUIRE(leaf_count(s) == 4);
  CHECK(prune(s, {}) == s);
  CHECK(leaf_count(prune(s, {1.5, 0})) == 3);
  // The fork loses its shorter prong; the longer one is of the trunk from then on.
  const CurveSkeleton pruned = prune(s, {3.2, 0});
  CHECK(leaf_count(pruned) == 2);
  CHECK(joint_count(pruned) == 0);
  CHECK(total_length(pruned) == Approx(13));
  CHECK(test::fault_of(pruned) == "");
}

TEST_CASE("thin end branches go", "[edits]") {
  CurveSkeleton s = straight_line(3);
  add_line(s, 1, {10.0 / 3, 20, 0}, 20, 0.1);
  const CurveSkeleton pruned = prune(s, {0, 0.5});
  CHECK(pruned == straight_line(3));
  CHECK(prune(s, {0, 0.05}) == s);
}

TEST_CASE("pruning leaves parts and cycles", "[edits]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed);
    INFO("seed " << seed);
    const double everything = 1e30;
    const CurveSkeleton core = prune(s, {everything, everything});
    REQUIRE(test::fault_of(core) == "");
    REQUIRE(component_count(core) == component_count(s));
    REQUIRE(cycle_count(core) == cycle_count(s));
    REQUIRE(prune(core, {everything, everything}) == core);
  }
}

TEST_CASE("edits refuse senseless limits", "[edits]") {
  const CurveSkeleton s = straight_line(3);
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(resample(s, wrong), Error);
    CHECK_THROWS_AS(resample_by_radius(s, wrong), Error);
    if (wrong != 0) {
      CHECK_THROWS_AS(simplify(s, wrong), Error);
      CHECK_THROWS_AS(prune(s, {wrong, 0}), Error);
      CHECK_THROWS_AS(prune(s, {0, wrong}), Error);
    }
  }
  CHECK_THROWS_AS(resample(s, 1e-300), Error);
}

TEST_CASE("a cycle basis has as many cycles as there are, each closed", "[edits]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed);
    INFO("seed " << seed);
    const std::vector<Branch> basis = cycle_basis(s);
    REQUIRE(static_cast<int>(basis.size()) == cycle_count(s));
    for (const Branch& cycle : basis) {
      REQUIRE(cycle.nodes.size() >= 4);
      REQUIRE(cycle.is_closed());
      for (std::size_t i = 1; i < cycle.nodes.size(); ++i) {
        const auto [a, b] = std::minmax(cycle.nodes[i - 1], cycle.nodes[i]);
        REQUIRE(std::binary_search(s.edges.begin(), s.edges.end(), CurveSkeleton::Edge{a, b}));
      }
      std::vector<NodeId> nodes(cycle.nodes.begin() + 1, cycle.nodes.end());
      std::sort(nodes.begin(), nodes.end());
      REQUIRE(std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end());
    }
  }
}

TEST_CASE("every edge is of one branch, whose lengths add up", "[edits]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed);
    const std::vector<Branch> all = branches(s);
    std::vector<std::size_t> edges(all.size());
    for (const std::uint32_t branch : branch_of_edges(s)) ++edges.at(branch);
    double length = 0;
    for (std::size_t b = 0; b < all.size(); ++b) {
      REQUIRE(edges[b] == all[b].nodes.size() - 1);
      length += length_of(s, all[b]);
    }
    REQUIRE(length == Approx(total_length(s)));
  }
}
