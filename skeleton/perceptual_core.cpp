#include <marrow/perceptual_core.hpp>

#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr NodeId kNone = ~NodeId{0};

/// Sets of leaves as linked lists, so that a set moves up a branch for nothing.
class LeafSets {
 public:
  explicit LeafSets(std::size_t nodes) : head_(nodes, kNone), tail_(nodes, kNone), next_(nodes, kNone) {}

  bool empty(NodeId at) const { return head_[at] == kNone; }
  NodeId first(NodeId at) const { return head_[at]; }
  NodeId next(NodeId leaf) const { return next_[leaf]; }

  void add(NodeId at, NodeId leaf) {
    next_[leaf] = kNone;
    (empty(at) ? head_[at] : next_[tail_[at]]) = leaf;
    tail_[at] = leaf;
  }
  /// Moves all leaves of `from` to the end of `at`.
  void join(NodeId at, NodeId from) {
    if (empty(from)) return;
    (empty(at) ? head_[at] : next_[tail_[at]]) = head_[from];
    tail_[at] = tail_[from];
  }
  void clear(NodeId at) { head_[at] = tail_[at] = kNone; }

 private:
  std::vector<NodeId> head_, tail_, next_;
};

/// Keeps the leaves of `at` whose balls are clear of the joint's, or the farthest.
void filter_at_joint(const VoteGraph& forest, LeafSets& leaves, NodeId at) {
  const auto& joint = forest.nodes[at];
  NodeId farthest = kNone, leaf = leaves.first(at);
  double greatest = -1;
  leaves.clear(at);
  while (leaf != kNone) {
    const NodeId next = leaves.next(leaf);
    const double d = distance(forest.nodes[leaf].position, joint.position);
    if (d >= forest.nodes[leaf].radius + joint.radius) leaves.add(at, leaf);
    if (d > greatest) greatest = d, farthest = leaf;
    leaf = next;
  }
  if (leaves.empty(at)) leaves.add(at, farthest);
}

}  // namespace

VoteGraph prune_by_zone_of_influence(const VoteGraph& forest) {
  const std::size_t n = forest.nodes.size();
  std::vector<NodeId> parent(n, kNone);
  std::vector<std::uint32_t> children(n, 0);
  for (const auto& [a, b] : forest.edges) parent[b] = a, ++children[a];

  LeafSets leaves(n);
  std::vector<std::uint8_t> keep(n, 0);
  for (auto i = static_cast<NodeId>(n); i-- > 0;) {
    const bool is_root = parent[i] == kNone;
    if (children[i] == 0 && !is_root) leaves.add(i, i);
    if (children[i] >= (is_root ? 3u : 2u)) filter_at_joint(forest, leaves, i);
    if (!is_root) {
      leaves.join(parent[i], i);
      continue;
    }
    keep[i] = 1;
    for (NodeId leaf = leaves.first(i); leaf != kNone; leaf = leaves.next(leaf))
      for (NodeId k = leaf; !keep[k]; k = parent[k]) keep[k] = 1;
  }

  LiveGraph graph(forest);
  for (NodeId i = 0; i < n; ++i)
    if (!keep[i]) graph.remove_node(i);
  return graph.result();
}

VoteGraph extract_perceptual_core(const VoteGraph& forest, double voxel) {
  return prune_leaves(prune_by_zone_of_influence(forest), voxel);
}

}  // namespace marrow
