// The paper promises that "the topology of the visual hull is preserved" but patches a tree; the
// voxels inside all silhouettes are that hull, and thinning them keeps the promise.
#include <marrow/distance_transform.hpp>
#include <marrow/homotopic_thinning.hpp>
#include <marrow/hull_topology.hpp>

#include <algorithm>
#include <tuple>

#include "live_graph_detail.hpp"
#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastPart = 0.02;        // of the greatest part's sum of support
constexpr int kBridgeSupport = 26;         // of 42 images; real thin limbs have 35 and more
constexpr std::uint16_t kVotedKey = 1000;  // above every depth in thirds of a voxel

std::vector<std::uint32_t> leaf_voxels(const VoteGraph& graph) {
  const LiveGraph live(graph);
  std::vector<std::uint32_t> voxels;
  for (NodeId n = 0; n < live.size(); ++n)
    if (live.degree(n) <= 1) voxels.push_back(live.node(n).voxel);
  return voxels;
}

/// Support of every voxel; 0 where nothing voted.
std::vector<std::uint8_t> support_map(const VoteGrid& votes) {
  std::vector<std::uint8_t> map(votes.grid.count(), 0);
  for (const auto& v : votes.votes) map[v.voxel] = v.support;
  return map;
}

/// A connected piece of the core outside the hull, and how often it meets the hull.
struct OutsideRun {
  std::vector<NodeId> nodes;
  int contacts = 0;
  int support = 0;  // sum

  bool is_doubtful_bridge() const {
    return contacts > 1 && support < kBridgeSupport * static_cast<int>(nodes.size());
  }
};

OutsideRun outside_run(const LiveGraph& core, const VoxelSet& hull, NodeId start,
                       std::vector<std::uint8_t>& seen) {
  OutsideRun run{{start}, 0, 0};
  seen[start] = 1;
  for (std::size_t k = 0; k < run.nodes.size(); ++k) {
    run.support += core.node(run.nodes[k]).support;
    for (const NodeId m : core.neighbours(run.nodes[k])) {
      if (hull[core.node(m).voxel])
        ++run.contacts;
      else if (!seen[m])
        seen[m] = 1, run.nodes.push_back(m);
    }
  }
  return run;
}

/// Adds the voxels of the core: limbs thinner than a voxel are in no hull of voxels. Where the core
/// only bridges two places of the hull on weak support, it would weld what is apart.
void add_core(VoxelSet& hull, const VoteGraph& core) {
  const LiveGraph live(core);
  const VoxelSet before = hull;
  std::vector<std::uint8_t> seen(live.size(), 0);
  for (NodeId n = 0; n < live.size(); ++n) {
    if (seen[n] || before[live.node(n).voxel]) continue;
    const OutsideRun run = outside_run(live, before, n, seen);
    if (run.is_doubtful_bridge()) continue;
    for (const NodeId m : run.nodes) hull[live.node(m).voxel] = 1;
  }
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

}  // namespace

VoxelSet supported_solid(const VoxelGrid& grid, VoxelSet hull, const VoteGrid& votes,
                         const VoteGraph& core) {
  add_core(hull, core);
  const auto support = support_map(votes);
  const auto parts = voxel_parts(grid, hull);
  std::vector<long> sums;
  for (const auto& part : parts) {
    long sum = 0;
    for (const auto v : part) sum += support[v];
    sums.push_back(sum);
  }
  const long greatest = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (static_cast<double>(sums[i]) < kLeastPart * static_cast<double>(greatest))
      for (const auto v : parts[i]) hull[v] = 0;
  return hull;
}

VoxelSet thin_by_votes(const VoteGrid& votes, const VoxelSet& solid, const VoteGraph& core) {
  std::vector<std::uint16_t> key = distance_transform(votes.grid, solid);
  for (auto& k : key) k = std::min<std::uint16_t>(k, kVotedKey - 1);
  for (const auto& v : votes.votes)
    key[v.voxel] = static_cast<std::uint16_t>(kVotedKey + v.support);
  return thin(votes.grid, solid, key, leaf_voxels(core));
}

VoteGraph graph_of(const VoteGrid& votes, const VoxelSet& solid, const VoxelSet& thin_set,
                   double pixel) {
  const VoxelGrid& grid = votes.grid;
  const auto depth = distance_transform(grid, solid);
  VoteGraph dense;
  std::vector<NodeId> node_at(grid.count(), ~NodeId{0});
  auto vote = votes.votes.begin();
  for (std::uint32_t v = 0; v < thin_set.size(); ++v) {
    if (!thin_set[v]) continue;
    while (vote != votes.votes.end() && vote->voxel < v) ++vote;
    node_at[v] = static_cast<NodeId>(dense.nodes.size());
    const bool voted = vote != votes.votes.end() && vote->voxel == v;
    const double radius = voted ? pixels_of(vote->radius) * pixel : pixels_of(depth[v]) * grid.size;
    dense.nodes.push_back({voted ? vote->position : grid.center(v), std::max(radius, grid.size),
                           voted ? int{vote->support} : 0, voted ? int{vote->broad_support} : 0,
                           v});
  }
  for (const auto& node : dense.nodes)
    for_neighbours(grid, node.voxel, [&](std::uint32_t n) {
      if (thin_set[n] && n > node.voxel) dense.edges.push_back({node_at[node.voxel], node_at[n]});
    });

  const LiveGraph live(dense);
  const LinkOrder key(grid, dense);
  VoteGraph graph{dense.nodes, {}};
  for (const auto& [a, b] : dense.edges)
    if (!is_longest(live, key, a, b)) graph.edges.push_back({a, b});
  return graph;
}

}  // namespace marrow
