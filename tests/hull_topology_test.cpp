#include <marrow/distance_transform.hpp>
#include <marrow/homotopic_thinning.hpp>
#include <marrow/hull_topology.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "catch.hpp"
#include "graphs.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

const VoxelGrid kGrid{{-1, -1, -1}, 0.1, 30, 20, 20};
constexpr double kPixel = 0.03;

void fill(VoxelSet& set, int x0, int x1, int y0, int y1, int z0, int z1, bool value = true) {
  for (int z = z0; z < z1; ++z)
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        value ? set.insert(kGrid.index(x, y, z)) : set.erase(kGrid.index(x, y, z));
}

VoxelSet empty_set() { return VoxelSet(kGrid); }

void add_vote(VoteGrid& votes, int x, int y, int z, int support) {
  Vote vote;
  vote.voxel = kGrid.index(x, y, z);
  vote.count = 1;
  vote.radius = 30;
  vote.support = static_cast<std::uint8_t>(support);
  vote.broad_support = static_cast<std::uint8_t>(support);
  vote.position = kGrid.center(vote.voxel) + Vec3{0.01, -0.02, 0.03};
  const auto after = std::find_if(votes.votes.begin(), votes.votes.end(),
                                  [&](const Vote& v) { return v.voxel > vote.voxel; });
  votes.votes.insert(after, vote);  // in the order of the voxels
}

/// A core along x through row (10, 10).
VoteGraph core_along_x(int x0, int x1, int support) {
  VoteGraph core;
  for (int x = x0; x < x1; ++x) {
    const auto voxel = kGrid.index(x, 10, 10);
    core.nodes.push_back({kGrid.center(voxel), 0.1, support, support, voxel});
    if (x > x0) add_edge(core, static_cast<NodeId>(x - x0 - 1), static_cast<NodeId>(x - x0));
  }
  return core;
}

/// Two blocks with a gap from x = 13 to 16, all voted for.
struct Blocks {
  VoxelSet hull = empty_set();
  VoteGrid votes{kGrid, {}};
};

Blocks two_blocks() {
  Blocks b;
  fill(b.hull, 4, 13, 7, 14, 7, 14);
  fill(b.hull, 17, 26, 7, 14, 7, 14);
  for (int x = 4; x < 26; ++x) add_vote(b.votes, x, 10, 10, 40);
  return b;
}

VoxelSet thinned(const VoteGrid& votes, const VoxelSet& solid, const VoteGraph& core) {
  return thin_by_votes(votes, solid, distance_transform(kGrid, solid), core);
}

VoteGraph graph_in(const VoteGrid& votes, const VoxelSet& solid, const VoxelSet& thin_set) {
  return graph_of(votes, solid, distance_transform(kGrid, solid), thin_set, kPixel);
}

}  // namespace

TEST_CASE("the core joins the hull, but for a weak bridge", "[hull_topology]") {
  const auto [hull, votes] = two_blocks();
  const auto bridge = kGrid.index(15, 10, 10);
  const VoxelSet strong = supported_solid(kGrid, hull, votes, core_along_x(6, 24, 26));
  CHECK(count(strong) == count(hull) + 4);
  CHECK(strong[bridge]);
  CHECK(supported_solid(kGrid, hull, votes, core_along_x(6, 24, 25)) == hull);
}

TEST_CASE("half of the images are enough for a bridge that alone joins two parts of samples",
          "[hull_topology]") {
  const Blocks blocks = two_blocks();
  const VoxelSet& hull = blocks.hull;
  const VoteGrid& votes = blocks.votes;
  const auto solid = [&](int support, HullOf of) {
    return supported_solid(kGrid, hull, votes, core_along_x(6, 24, support), of);
  };
  CHECK(count(solid(21, HullOf::Samples)) == count(hull) + 4);
  CHECK(solid(20, HullOf::Samples) == hull);
  CHECK(solid(25, HullOf::Body) == hull);
  // Of two, the better one joins them, and the other then welds them.
  VoteGraph both = core_along_x(6, 24, 22);
  const VoteGraph better = core_along_x(6, 24, 25);
  const auto first = static_cast<NodeId>(both.nodes.size());
  for (auto node : better.nodes) {
    node.voxel += static_cast<std::uint32_t>(2 * kGrid.nx);
    both.nodes.push_back(node);
  }
  for (const auto& [a, b] : better.edges) both.edges.push_back({a + first, b + first});
  const VoxelSet joined = supported_solid(kGrid, hull, votes, both, HullOf::Samples);
  CHECK(joined[kGrid.index(15, 12, 10)]);
  CHECK_FALSE(joined[kGrid.index(15, 10, 10)]);
}

TEST_CASE("a weak limb that bridges nothing joins the hull", "[hull_topology]") {
  const auto [hull, votes] = two_blocks();
  VoxelSet expected = hull;
  fill(expected, 13, 16, 10, 11, 10, 11);
  CHECK(supported_solid(kGrid, hull, votes, core_along_x(6, 16, 9)) == expected);
}

TEST_CASE("the mean over a bridge counts", "[hull_topology]") {
  const auto [hull, votes] = two_blocks();
  VoteGraph core = core_along_x(6, 24, 40);
  core.nodes[8].support = 10;  // one of the four of the bridge
  CHECK(supported_solid(kGrid, hull, votes, core)[kGrid.index(14, 10, 10)]);
  core.nodes[9].support = core.nodes[10].support = 10;
  CHECK(supported_solid(kGrid, hull, votes, core) == hull);
}

TEST_CASE("parts with little support go", "[hull_topology]") {
  auto [hull, votes] = two_blocks();
  for (const int support : {0, 6, 8}) {
    VoxelSet with_speck = hull;
    fill(with_speck, 5, 8, 2, 4, 2, 4);
    VoteGrid more = votes;
    if (support > 0) add_vote(more, 5, 2, 2, support);
    // Each block has 9 votes of 40 = 360; 2 % of it is 7.2.
    const VoxelSet solid = supported_solid(kGrid, with_speck, more, {});
    CHECK(solid == (support < 7 ? hull : with_speck));
  }
  CHECK(count(supported_solid(kGrid, empty_set(), {kGrid, {}}, {})) == 0);
}

TEST_CASE("thinning ends on the votes and at the core's leaves", "[hull_topology]") {
  VoxelSet bar = empty_set();
  fill(bar, 3, 27, 6, 15, 6, 15);
  VoteGrid votes{kGrid, {}};
  for (int x = 5; x < 25; ++x) add_vote(votes, x, 8, 10, 20);   // not in the middle of the bar,
  for (int x = 5; x < 25; ++x) add_vote(votes, x, 12, 10, 40);  // and the stronger line wins
  VoteGraph core;
  for (const int x : {5, 24}) {
    const auto voxel = kGrid.index(x, 12, 10);
    core.nodes.push_back({kGrid.center(voxel), 0.1, 40, 40, voxel});
  }
  add_edge(core, 0, 1);
  const VoxelSet line = thinned(votes, bar, core);
  VoxelSet expected = empty_set();
  fill(expected, 5, 25, 12, 13, 10, 11);
  CHECK(line == expected);
}

TEST_CASE("a limb whose end the solid lacks ends where it leaves the solid", "[hull_topology]") {
  VoxelSet bar = empty_set();
  fill(bar, 6, 24, 7, 14, 7, 14);
  const VoxelSet line = thinned({kGrid, {}}, bar, core_along_x(3, 28, 40));
  CHECK(line[kGrid.index(6, 10, 10)]);
  CHECK(line[kGrid.index(23, 10, 10)]);
  CHECK(count(line) == 18);
}

TEST_CASE("a tunnel of the solid stays a cycle", "[hull_topology]") {
  VoxelSet ring = empty_set();
  fill(ring, 4, 26, 3, 17, 8, 12);
  fill(ring, 10, 20, 7, 13, 8, 12, false);
  const VoteGrid votes{kGrid, {}};
  const VoxelSet thin_set = thinned(votes, ring, {});
  const VoteGraph graph = graph_in(votes, ring, thin_set);
  CHECK(graph.nodes.size() == count(thin_set));
  CHECK(component_count(counts_of(graph)) == 1);
  CHECK(cycle_count(counts_of(graph)) == 1);
  CHECK(leaf_count(counts_of(graph)) == 0);
}

TEST_CASE("nodes of the graph stand where the votes say", "[hull_topology]") {
  VoxelSet solid = empty_set();
  fill(solid, 3, 27, 6, 15, 6, 15);
  VoxelSet line = empty_set();
  fill(line, 10, 13, 10, 11, 10, 11);
  VoteGrid votes{kGrid, {}};
  add_vote(votes, 9, 10, 10, 42);  // not in the set
  add_vote(votes, 11, 10, 10, 33);
  const VoteGraph graph = graph_in(votes, solid, line);
  REQUIRE(graph.nodes.size() == 3);
  CHECK(graph.edges == std::vector<CurveSkeleton::Edge>{{0, 1}, {1, 2}});
  CHECK(graph.nodes[1].position == votes.votes[1].position);
  CHECK(graph.nodes[1].support == 33);
  CHECK(graph.nodes[1].broad_support == 33);
  CHECK(graph.nodes[1].radius == Approx(pixels_of(30) * kPixel));
  CHECK(graph.nodes[0].position == kGrid.center(kGrid.index(10, 10, 10)));
  CHECK(graph.nodes[0].support == 0);
  CHECK(graph.nodes[0].radius == Approx((5 - 0.5) * kGrid.size));  // five voxels deep
  CHECK(graph.nodes[2].voxel == kGrid.index(12, 10, 10));
}

TEST_CASE("corners of the voxels make no triangles", "[hull_topology]") {
  // An L of three voxels: the diagonal is the longest side.
  VoxelSet corner = empty_set();
  for (const auto& [x, y] : {std::pair(5, 5), {6, 5}, {6, 6}}) corner.insert(kGrid.index(x, y, 5));
  const VoteGraph graph = graph_in({kGrid, {}}, corner, corner);
  CHECK(graph.edges == std::vector<CurveSkeleton::Edge>{{0, 1}, {1, 2}});
}

TEST_CASE("of every triangle of voxels the longest side goes", "[hull_topology]") {
  Random random(1);
  const VoxelGrid g{{0, 0, 0}, 1, 8, 7, 6};
  VoxelSet set(g);
  for (std::uint32_t v = 0; v < g.count(); ++v)
    if (random.below(100) < 25) set.insert(v);
  const std::vector<ChamferDistance> depth(count(set), 3);
  const VoteGraph graph = graph_of({g, {}}, set, depth, set, kPixel);
  const auto n = static_cast<NodeId>(graph.nodes.size());
  REQUIRE(n == count(set));
  const auto length = [&](NodeId a, NodeId b) {
    const Vec3 d = graph.nodes[a].position - graph.nodes[b].position;
    return std::tuple(std::lround(squared_length(d)), std::min(a, b), std::max(a, b));
  };
  const auto near = [&](NodeId a, NodeId b) {
    const Vec3 d = graph.nodes[a].position - graph.nodes[b].position;
    return a != b && std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < 1.5;
  };
  std::vector<CurveSkeleton::Edge> expected;
  for (NodeId a = 0; a < n; ++a)
    for (NodeId b = a + 1; b < n; ++b) {
      bool stays = near(a, b);
      for (NodeId c = 0; c < n && stays; ++c)
        stays = !(near(a, c) && near(b, c) && length(a, b) > length(a, c) &&
                  length(a, b) > length(b, c));
      if (stays) expected.push_back({a, b});
    }
  CHECK(expected.size() > 50);
  CHECK(graph.edges == expected);
}
