// After Yim, Choyke and Summers, "Gray-scale skeletonization of small vessels in magnetic resonance
// angiography" (2000): the order in which voxels join is the order of their keys.
#include <marrow/distance_transform.hpp>
#include <marrow/region_growing.hpp>

#include <algorithm>
#include <queue>
#include <tuple>

#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr int kLeastSupport = 8;       // of 42 images
constexpr double kLeastRegion = 0.02;  // of the greatest region's sum of support
constexpr std::uint32_t kNoVote = ~0u;

/// Votes by rank: rank 0 is the strongest. A total order, so that growth is the same everywhere.
std::vector<std::uint32_t> ranked(const std::vector<Vote>& votes) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < votes.size(); ++i)
    if (votes[i].support >= kLeastSupport) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto key = [&](std::uint32_t i) {
      const Vote& v = votes[i];
      return std::tuple(-int{v.support}, ~v.count, -int{v.radius}, v.voxel);
    };
    return key(a) < key(b);
  });
  return order;
}

struct Region {
  VoteGraph tree;
  long support = 0;
};

class Growth {
 public:
  Growth(const VoteGrid& votes, double pixel)
      : votes_(votes),
        pixel_(pixel),
        order_(ranked(votes.votes)),
        rank_at_(votes.grid.count(), kNoVote),
        node_of_(order_.size(), kNoVote) {
    for (std::uint32_t r = 0; r < order_.size(); ++r) rank_at_[votes.votes[order_[r]].voxel] = r;
  }

  std::vector<Region> grow() {
    std::vector<Region> regions;
    for (std::uint32_t seed = 0; seed < order_.size(); ++seed)
      if (node_of_[seed] == kNoVote) regions.push_back(grow_from(seed));
    return regions;
  }

 private:
  Region grow_from(std::uint32_t seed) {
    Region region;
    // The frontier holds (rank, parent's rank): the strongest voxel joins first, and hangs on the
    // strongest of its neighbours that have joined.
    std::priority_queue<std::pair<std::uint32_t, std::uint32_t>,
                        std::vector<std::pair<std::uint32_t, std::uint32_t>>, std::greater<>>
        frontier;
    frontier.push({seed, kNoVote});
    while (!frontier.empty()) {
      // No structured binding: clang 14 cannot capture one.
      const std::uint32_t rank = frontier.top().first, parent = frontier.top().second;
      frontier.pop();
      if (node_of_[rank] != kNoVote) continue;
      const Vote& vote = votes_.votes[order_[rank]];
      const auto id = static_cast<NodeId>(region.tree.nodes.size());
      node_of_[rank] = id;
      // Radii finer than a voxel mean nothing to the graph.
      const double radius = std::max(pixels_of(vote.radius) * pixel_, votes_.grid.size);
      region.tree.nodes.push_back(
          {vote.position, radius, vote.support, vote.broad_support, vote.voxel});
      if (parent != kNoVote) region.tree.edges.push_back({node_of_[parent], id});
      region.support += vote.support;
      for_neighbours(votes_.grid, vote.voxel, [&](std::uint32_t voxel) {
        const std::uint32_t n = rank_at_[voxel];
        if (n != kNoVote && node_of_[n] == kNoVote) frontier.push({n, rank});
      });
    }
    return region;
  }

  const VoteGrid& votes_;
  double pixel_;
  std::vector<std::uint32_t> order_, rank_at_, node_of_;
};

void append(VoteGraph& graph, const VoteGraph& part) {
  const auto base = static_cast<NodeId>(graph.nodes.size());
  graph.nodes.insert(graph.nodes.end(), part.nodes.begin(), part.nodes.end());
  for (const auto& [a, b] : part.edges) graph.edges.push_back({a + base, b + base});
}

}  // namespace

VoteGraph grow_spanning_tree(const VoteGrid& votes, double pixel) {
  const auto regions = Growth(votes, pixel).grow();
  long greatest = 0;
  for (const auto& r : regions) greatest = std::max(greatest, r.support);
  VoteGraph forest;
  for (const auto& r : regions)
    if (static_cast<double>(r.support) >= kLeastRegion * static_cast<double>(greatest))
      append(forest, r.tree);
  return forest;
}

}  // namespace marrow
