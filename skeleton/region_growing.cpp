// After Yim, Choyke and Summers, "Gray-scale skeletonization of small vessels in magnetic resonance
// angiography" (2000): the order in which voxels join is the order of their keys.
#include <marrow/distance_transform.hpp>
#include <marrow/region_growing.hpp>

#include <algorithm>
#include <numeric>
#include <span>

#include "rank_queue_detail.hpp"
#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr int kLeastSupport = 8;       // of 42 images
constexpr double kLeastRegion = 0.02;  // of the greatest region's sum of support
constexpr std::uint32_t kNone = ~0u;

/// A vote that grows, by its place among all votes, and what it is ranked by.
struct Candidate {
  std::uint64_t strength;
  std::uint32_t vote;
};

/// The candidates in the order of the votes.
std::vector<Candidate> candidates(const std::vector<Vote>& votes) {
  std::vector<Candidate> result;
  for (std::uint32_t i = 0; i < votes.size(); ++i) {
    const Vote& v = votes[i];
    if (v.support >= kLeastSupport)
      result.push_back(
          {std::uint64_t{v.support} << 48 | std::uint64_t{v.count} << 16 | v.radius, i});
  }
  return result;
}

/// The places of candidates by rank: 0 is the strongest. A total order, so that growth is the same
/// everywhere.
std::vector<std::uint32_t> ranked(const std::vector<Candidate>& candidates) {
  std::vector<std::uint32_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return candidates[a].strength > candidates[b].strength;
  });
  return order;
}

/// The neighbours of every voxel in one array.
class Neighbours {
 public:
  Neighbours(std::size_t n, const std::vector<CurveSkeleton::Edge>& pairs)
      : start_(n + 1, 0), neighbour_(2 * pairs.size()) {
    for (const auto& [a, b] : pairs) ++start_[a], ++start_[b];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    for (const auto& [a, b] : pairs) neighbour_[--start_[a]] = b, neighbour_[--start_[b]] = a;
  }

  std::span<const std::uint32_t> of(std::uint32_t i) const {
    return std::span(neighbour_).subspan(start_[i], start_[i + 1] - start_[i]);
  }

 private:
  std::vector<std::uint32_t> start_, neighbour_;
};

/// Voxels that joined one after the other: begin <= i < end of the growth.
struct Region {
  std::size_t begin = 0, end = 0;
  long support = 0;
};

/// A voxel that joined, and the one before it that it hangs on.
struct Joined {
  std::uint32_t vote, parent;
};

class Growth {
 public:
  explicit Growth(const VoteGrid& votes)
      : votes_(votes.votes),
        candidates_(candidates(votes_)),
        order_(ranked(candidates_)),
        rank_(order_.size()),
        neighbours_(order_.size(), neighbour_pairs(votes.grid, voxels())),
        parent_(order_.size(), kNone),
        place_(order_.size(), kNone),
        frontier_(order_.size()) {
    for (std::uint32_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = r;
    for (std::uint32_t seed = 0; seed < order_.size(); ++seed)
      if (place_[seed] == kNone) grow_from(seed);
  }

  const std::vector<Region>& regions() const { return regions_; }
  const std::vector<Joined>& joined() const { return joined_; }

 private:
  std::vector<std::uint32_t> voxels() const {
    std::vector<std::uint32_t> result;
    for (const auto& c : candidates_) result.push_back(votes_[c.vote].voxel);
    return result;
  }

  /// The strongest voxel of the frontier joins first, and hangs on the strongest of its neighbours
  /// that have joined.
  void grow_from(std::uint32_t seed) {
    Region region{joined_.size(), 0, 0};
    frontier_.push(seed);
    while (!frontier_.empty()) {
      const std::uint32_t rank = frontier_.pop(), candidate = order_[rank];
      place_[rank] = static_cast<std::uint32_t>(joined_.size());
      const std::uint32_t parent = parent_[rank];
      joined_.push_back({candidates_[candidate].vote, parent == kNone ? kNone : place_[parent]});
      region.support += votes_[joined_.back().vote].support;
      for (const std::uint32_t neighbour : neighbours_.of(candidate)) {
        const std::uint32_t n = rank_[neighbour];
        if (place_[n] != kNone) continue;
        parent_[n] = std::min(parent_[n], rank);
        frontier_.push(n);
      }
    }
    region.end = joined_.size();
    regions_.push_back(region);
  }

  const std::vector<Vote>& votes_;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> order_, rank_;  // candidates by rank, and back
  Neighbours neighbours_;
  std::vector<std::uint32_t> parent_, place_;  // by rank: best neighbour so far, place in joined_
  RankQueue frontier_;
  std::vector<Region> regions_;
  std::vector<Joined> joined_;
};

}  // namespace

VoteGraph grow_spanning_tree(const VoteGrid& votes, double pixel) {
  const Growth growth(votes);
  long greatest = 0;
  for (const auto& r : growth.regions()) greatest = std::max(greatest, r.support);
  VoteGraph forest;
  for (const auto& r : growth.regions()) {
    if (static_cast<double>(r.support) < kLeastRegion * static_cast<double>(greatest)) continue;
    const std::size_t shift = r.begin - forest.nodes.size();
    for (std::size_t i = r.begin; i < r.end; ++i) {
      const auto [index, parent] = growth.joined()[i];
      const Vote& vote = votes.votes[index];
      // Radii finer than a voxel mean nothing to the graph.
      const double radius = std::max(pixels_of(vote.radius) * pixel, votes.grid.size);
      if (parent != kNone)
        forest.edges.push_back(
            {static_cast<NodeId>(parent - shift), static_cast<NodeId>(i - shift)});
      forest.nodes.push_back({vote.position, radius, vote.support, vote.broad_support, vote.voxel});
    }
  }
  return forest;
}

}  // namespace marrow
