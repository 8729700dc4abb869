// The paper promises that "the topology of the visual hull is preserved" but patches a tree; the
// voxels inside all silhouettes are that hull, and thinning them keeps the promise.
#include <marrow/distance_transform.hpp>
#include <marrow/homotopic_thinning.hpp>
#include <marrow/hull_topology.hpp>

#include <algorithm>
#include <bit>
#include <tuple>

#include "core_in_hull_detail.hpp"
#include "live_graph_detail.hpp"
#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastPart = 0.02;        // of the greatest part's sum of support
constexpr std::uint16_t kVotedKey = 1000;  // above every depth in thirds of a voxel

/// The ends of the core as far as the solid holds them: where the very end of a limb has been left
/// out, the limb still ends where it leaves the solid.
std::vector<std::uint32_t> leaf_voxels(const VoteGraph& graph, const VoxelSet& solid) {
  const LiveGraph live(graph);
  std::vector<std::uint32_t> voxels;
  for (NodeId leaf = 0; leaf < live.size(); ++leaf) {
    if (live.degree(leaf) > 1) continue;
    const std::vector<NodeId> branch = trace_leaf_branch(live, leaf).nodes;
    const auto last = std::find_if(branch.begin(), branch.end(),
                                   [&](NodeId n) { return solid[live.node(n).voxel]; });
    if (last != branch.end()) voxels.push_back(live.node(*last).voxel);
  }
  return voxels;
}

/// The sum of support over every part of a solid.
std::vector<long> support_of_parts(const VoxelGrid& grid, const RunParts& parts,
                                   const std::vector<Vote>& votes) {
  std::vector<long> sums(parts.count, 0);
  auto vote = votes.begin();
  for (std::size_t i = 0; i < parts.runs.size(); ++i) {
    const VoxelRun& run = parts.runs[i];
    const std::uint32_t first =
        run.row * static_cast<std::uint32_t>(grid.nx) + static_cast<std::uint32_t>(run.first);
    const std::uint32_t end = first + static_cast<std::uint32_t>(run.size());
    while (vote != votes.end() && vote->voxel < first) ++vote;
    for (; vote != votes.end() && vote->voxel < end; ++vote) sums[parts.part[i]] += vote->support;
  }
  return sums;
}

/// Orders the edges of a graph by length; a total order.
class LinkOrder {
 public:
  LinkOrder(const VoxelGrid& grid, const VoteGraph& graph) : grid_(grid), graph_(graph) {}

  std::tuple<int, NodeId, NodeId> operator()(NodeId a, NodeId b) const {
    const auto va = graph_.nodes[a].voxel, vb = graph_.nodes[b].voxel;
    const int dx = grid_.x_of(va) - grid_.x_of(vb), dy = grid_.y_of(va) - grid_.y_of(vb),
              dz = grid_.z_of(va) - grid_.z_of(vb);
    return {dx * dx + dy * dy + dz * dz, std::min(a, b), std::max(a, b)};
  }

 private:
  const VoxelGrid& grid_;
  const VoteGraph& graph_;
};

/// Whether edge a-b is the longest of a triangle.
bool is_longest(const LiveGraph& graph, const LinkOrder& key, NodeId a, NodeId b) {
  for (const NodeId c : graph.neighbours(a)) {
    const auto others = graph.neighbours(b);
    if (std::find(others.begin(), others.end(), c) == others.end()) continue;
    if (key(a, b) > key(a, c) && key(a, b) > key(b, c)) return true;
  }
  return false;
}

/// Calls visit(voxel, place) for every voxel of `part`, with its place among those of `whole`.
template <class Visit>
void for_each_place(const VoxelSet& whole, const VoxelSet& part, Visit visit) {
  std::size_t before = 0;
  auto word = whole.words().begin();
  part.for_each_word([&](std::uint32_t first, VoxelSet::Word left) {
    for (const VoxelSet::Word all = *word; left != 0; left &= left - 1) {
      const VoxelSet::Word low = left & (~left + 1);
      visit(first + static_cast<std::uint32_t>(std::countr_zero(left)),
            before + static_cast<std::size_t>(std::popcount(all & (low - 1))));
    }
    if (*word != 0) before += static_cast<std::size_t>(std::popcount(*word));
    ++word;
  });
}

/// The voxels of a thin set as nodes, in their order. `depth` is that of the solid it comes from.
std::vector<VoteGraph::Node> nodes_of(const VoteGrid& votes, const VoxelSet& solid,
                                      std::span<const ChamferDistance> depth,
                                      const VoxelSet& thin_set, double pixel) {
  const VoxelGrid& grid = votes.grid;
  std::vector<VoteGraph::Node> nodes;
  auto vote = votes.votes.begin();
  for_each_place(solid, thin_set, [&](std::uint32_t voxel, std::size_t place) {
    while (vote != votes.votes.end() && vote->voxel < voxel) ++vote;
    const bool voted = vote != votes.votes.end() && vote->voxel == voxel;
    const double radius =
        voted ? pixels_of(vote->radius) * pixel : pixels_of(depth[place]) * grid.size;
    nodes.push_back({voted ? vote->position : grid.center(voxel), std::max(radius, grid.size),
                     voted ? int{vote->support} : 0, voted ? int{vote->broad_support} : 0, voxel});
  });
  return nodes;
}

}  // namespace

VoxelSet supported_solid(const VoxelGrid& grid, VoxelSet hull, const VoteGrid& votes,
                         const VoteGraph& core, HullOf of) {
  add_core(grid, hull, core, of);
  const RunParts parts = run_parts(hull);
  const std::vector<long> sums = support_of_parts(grid, parts, votes.votes);
  const long greatest = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
  for (std::size_t i = 0; i < parts.runs.size(); ++i) {
    const bool is_weak =
        static_cast<double>(sums[parts.part[i]]) < kLeastPart * static_cast<double>(greatest);
    if (is_weak) erase(hull, parts.runs[i]);
  }
  return hull;
}

VoxelSet thin_by_votes(const VoteGrid& votes, const VoxelSet& solid,
                       std::span<const ChamferDistance> depth, const VoteGraph& core) {
  std::vector<std::uint16_t> key(depth.begin(), depth.end());
  for (auto& k : key) k = std::min<std::uint16_t>(k, kVotedKey - 1);
  VoxelSet voted(votes.grid);
  for (const auto& v : votes.votes)
    if (solid[v.voxel]) voted.insert(v.voxel);
  auto vote = votes.votes.begin();
  for_each_place(solid, voted, [&](std::uint32_t voxel, std::size_t place) {
    while (vote->voxel < voxel) ++vote;
    key[place] = static_cast<std::uint16_t>(kVotedKey + vote->support);
  });
  return thin(votes.grid, solid, key, leaf_voxels(core, solid));
}

VoteGraph graph_of(const VoteGrid& votes, const VoxelSet& solid,
                   std::span<const ChamferDistance> depth, const VoxelSet& thin_set, double pixel) {
  VoteGraph dense{nodes_of(votes, solid, depth, thin_set, pixel), {}};
  std::vector<std::uint32_t> voxels;
  for (const auto& node : dense.nodes) voxels.push_back(node.voxel);
  dense.edges = neighbour_pairs(votes.grid, voxels);

  const LiveGraph live(dense);
  const LinkOrder key(votes.grid, dense);
  VoteGraph graph{dense.nodes, {}};
  for (const auto& [a, b] : dense.edges)
    if (!is_longest(live, key, a, b)) graph.edges.push_back({a, b});
  return graph;
}

}  // namespace marrow
