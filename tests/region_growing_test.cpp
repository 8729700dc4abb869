#include <marrow/distance_transform.hpp>
#include <marrow/region_growing.hpp>

#include <map>
#include <tuple>

#include "catch.hpp"
#include "graphs.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

const VoxelGrid kGrid{{0, 0, 0}, 0.1, 14, 12, 10};
constexpr double kPixel = 0.04;
constexpr NodeId kNone = ~NodeId{0};

void add_vote(VoteGrid& grid, int x, int y, int z, int support, std::uint32_t count = 1,
              ChamferDistance radius = 12) {
  Vote vote;
  vote.voxel = grid.grid.index(x, y, z);
  vote.count = count;
  vote.radius = radius;
  vote.support = static_cast<std::uint8_t>(support);
  vote.broad_support = static_cast<std::uint8_t>(std::min(42, support + 3));
  vote.position = grid.grid.center(vote.voxel);
  grid.votes.push_back(vote);
}

/// Few different values, so that ties are common.
VoteGrid random_votes(std::uint64_t seed) {
  Random random(seed);
  VoteGrid grid{kGrid, {}};
  for (int z = 0; z < kGrid.nz; ++z)
    for (int y = 0; y < kGrid.ny; ++y)
      for (int x = 0; x < kGrid.nx; ++x) {
        if (random.below(100) >= 20) continue;
        add_vote(grid, x, y, z, 5 + static_cast<int>(random.below(38)),
                 1 + static_cast<std::uint32_t>(random.below(3)),
                 static_cast<ChamferDistance>(3 + random.below(4)));
      }
  return grid;
}

/// Rank of every voxel by the key that the header promises; 0 is the strongest.
std::map<std::uint32_t, int> ranks(const VoteGrid& grid) {
  std::vector<Vote> votes = grid.votes;
  std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
    return std::tuple(a.support, a.count, a.radius, b.voxel) >
           std::tuple(b.support, b.count, b.radius, a.voxel);
  });
  std::map<std::uint32_t, int> rank;
  for (const Vote& v : votes)
    if (v.support >= 8) rank.emplace(v.voxel, static_cast<int>(rank.size()));
  return rank;
}

bool are_neighbours(std::uint32_t a, std::uint32_t b) {
  return a != b && std::abs(kGrid.x_of(a) - kGrid.x_of(b)) <= 1 &&
         std::abs(kGrid.y_of(a) - kGrid.y_of(b)) <= 1 &&
         std::abs(kGrid.z_of(a) - kGrid.z_of(b)) <= 1;
}

}  // namespace

TEST_CASE("each region grows by its strongest neighbour", "[region_growing]") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const VoteGrid grid = random_votes(seed);
    const auto rank = ranks(grid);
    const VoteGraph tree = grow_spanning_tree(grid, kPixel);
    REQUIRE(tree.nodes.size() > 100);
    CHECK(cycle_count(counts_of(tree)) == 0);

    std::map<std::uint32_t, NodeId> node_at;
    for (NodeId n = 0; n < tree.nodes.size(); ++n) {
      REQUIRE(rank.count(tree.nodes[n].voxel) == 1);
      CHECK(node_at.emplace(tree.nodes[n].voxel, n).second);
    }
    std::vector<NodeId> parent(tree.nodes.size(), kNone);
    for (const auto& [p, child] : tree.edges) {
      REQUIRE(p < child);
      CHECK(parent[child] == kNone);
      parent[child] = p;
    }
    const auto rank_of = [&](NodeId n) { return rank.at(tree.nodes[n].voxel); };
    for (NodeId n = 0; n < tree.nodes.size(); ++n) {
      // The parent is the strongest neighbour that was there before.
      NodeId best = kNone;
      for (NodeId m = 0; m < n; ++m)
        if (are_neighbours(tree.nodes[n].voxel, tree.nodes[m].voxel) &&
            (best == kNone || rank_of(m) < rank_of(best)))
          best = m;
      CHECK(parent[n] == best);
    }
    // Every voxel that joins is the strongest of all that touch those before it, until none does.
    for (NodeId n = 1; n < tree.nodes.size(); ++n) {
      int strongest = 1 << 20;
      for (const auto& [voxel, r] : rank) {
        if (r >= strongest || (node_at.count(voxel) != 0 && node_at.at(voxel) < n)) continue;
        for (NodeId m = n; m-- > 0;) {
          if (are_neighbours(voxel, tree.nodes[m].voxel)) strongest = r;
          if (strongest == r || parent[m] == kNone) break;  // a root: what is before is not its own
        }
      }
      if (parent[n] == kNone) CHECK(strongest == 1 << 20);
      if (parent[n] != kNone) CHECK(rank_of(n) == strongest);
    }
  }
}

TEST_CASE("votes with a support under 8 are not seen", "[region_growing]") {
  VoteGrid grid{kGrid, {}};
  for (int x = 1; x < 10; ++x) add_vote(grid, x, 5, 5, x == 5 ? 7 : 8);
  const VoteGraph graph = grow_spanning_tree(grid, kPixel);
  CHECK(graph.nodes.size() == 8);
  CHECK(component_count(counts_of(graph)) == 2);
}

TEST_CASE("regions under 2 % of the greatest go", "[region_growing]") {
  for (const int support : {40, 43}) {
    VoteGrid grid{kGrid, {}};
    add_vote(grid, 1, 1, 1, support);
    for (int y = 4; y < 9; ++y)
      for (int x = 2; x < 12; ++x) add_vote(grid, x, y, 6, 42);  // 2 % of all is 42
    const VoteGraph graph = grow_spanning_tree(grid, kPixel);
    CHECK(graph.nodes.size() == (support < 42 ? 50 : 51));
    CHECK(component_count(counts_of(graph)) == (support < 42 ? 1 : 2));
  }
}

TEST_CASE("nodes take over what their votes say", "[region_growing]") {
  VoteGrid grid{kGrid, {}};
  add_vote(grid, 3, 3, 3, 20, 5, 3);
  add_vote(grid, 4, 3, 3, 30, 5, 60);
  grid.votes[0].position = {0.31, 0.35, 0.38};
  const VoteGraph graph = grow_spanning_tree(grid, kPixel);
  REQUIRE(graph.nodes.size() == 2);
  CHECK(graph.edges == std::vector<CurveSkeleton::Edge>{{0, 1}});
  CHECK(graph.nodes[0].support == 30);  // the stronger one is the seed
  CHECK(graph.nodes[0].broad_support == 33);
  CHECK(graph.nodes[0].radius == Approx(pixels_of(60) * kPixel));
  CHECK(graph.nodes[1].radius == kGrid.size);  // a voxel at least
  CHECK(graph.nodes[1].position == Vec3{0.31, 0.35, 0.38});
  CHECK(graph.nodes[1].voxel == kGrid.index(3, 3, 3));
}

TEST_CASE("without votes there is no tree", "[region_growing]") {
  CHECK(grow_spanning_tree({kGrid, {}}, kPixel) == VoteGraph{});
}
