#include <marrow/perceptual_core.hpp>

#include <algorithm>

#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr NodeId kNone = ~NodeId{0};

/// One tree of a forest, walked from a root: parents come before their children.
struct RootedTree {
  std::vector<NodeId> order;
  std::vector<NodeId>& parent;  // of every node of the forest; a root has none

  NodeId root() const { return order.front(); }
};

RootedTree walk_tree(const LiveGraph& forest, NodeId root, std::vector<NodeId>& parent) {
  RootedTree tree{{root}, parent};
  parent[root] = kNone;
  for (std::size_t k = 0; k < tree.order.size(); ++k) {
    const NodeId n = tree.order[k];
    for (const NodeId m : forest.neighbours(n))
      if (m != parent[n]) parent[m] = n, tree.order.push_back(m);
  }
  return tree;
}

/// The node farthest from the root along the tree, and `depth` of all its nodes.
NodeId farthest(const LiveGraph& forest, const RootedTree& tree, std::vector<double>& depth) {
  NodeId far = tree.root();
  for (const NodeId n : tree.order) {
    const NodeId p = tree.parent[n];
    depth[n] = p == kNone ? 0 : depth[p] + forest.length(n, p);
    if (depth[n] > depth[far]) far = n;
  }
  return far;
}

/// The middle of the longest path of the tree that holds `any`: as far from all tips as can be.
NodeId middle_of_tree(const LiveGraph& forest, NodeId any, std::vector<NodeId>& parent,
                      std::vector<double>& depth) {
  const NodeId one_end = farthest(forest, walk_tree(forest, any, parent), depth);
  NodeId n = farthest(forest, walk_tree(forest, one_end, parent), depth);
  const double half = 0.5 * depth[n];
  while (depth[n] > half) n = parent[n];
  return n;
}

/// How much an edge tells: its length, by how many images support it.
double significance(const LiveGraph& forest, NodeId a, NodeId b) {
  const double support = 0.5 * (forest.node(a).support + forest.node(b).support) / kImages;
  return forest.length(a, b) * support * support * support;
}

/// Sets of leaves as linked lists, so that a set moves up a branch for nothing.
class LeafSets {
 public:
  explicit LeafSets(std::size_t nodes)
      : head_(nodes, kNone), tail_(nodes, kNone), next_(nodes, kNone) {}

  NodeId first(NodeId at) const { return head_[at]; }
  NodeId next(NodeId leaf) const { return next_[leaf]; }

  void add(NodeId at, NodeId leaf) {
    next_[leaf] = kNone;
    (head_[at] == kNone ? head_[at] : next_[tail_[at]]) = leaf;
    tail_[at] = leaf;
  }
  /// Moves all leaves of `from` to the end of `at`.
  void join(NodeId at, NodeId from) {
    if (head_[from] == kNone) return;
    (head_[at] == kNone ? head_[at] : next_[tail_[at]]) = head_[from];
    tail_[at] = tail_[from];
  }
  /// Takes the leaves of `at` out.
  std::vector<NodeId> take(NodeId at) {
    std::vector<NodeId> leaves;
    for (NodeId leaf = head_[at]; leaf != kNone; leaf = next_[leaf]) leaves.push_back(leaf);
    head_[at] = tail_[at] = kNone;
    return leaves;
  }

 private:
  std::vector<NodeId> head_, tail_, next_;
};

class ZonePruner {
 public:
  ZonePruner(const VoteGraph& forest, Zone zone)
      : forest_(forest),
        zone_(zone),
        parent_(forest.nodes.size(), kNone),
        along_(forest.nodes.size(), 0),
        leaves_(forest.nodes.size()),
        visited_(forest.nodes.size(), 0),
        keep_(forest.nodes.size(), 0) {}

  VoteGraph prune() {
    for (NodeId n = 0; n < forest_.size(); ++n)
      if (!visited_[n]) prune_tree(n);
    LiveGraph result = forest_;
    for (NodeId n = 0; n < result.size(); ++n)
      if (!keep_[n]) result.remove_node(n);
    return result.result();
  }

 private:
  void prune_tree(NodeId any) {
    const NodeId root = middle_of_tree(forest_, any, parent_, along_);
    const RootedTree tree = walk_tree(forest_, root, parent_);
    for (const NodeId n : tree.order) {
      visited_[n] = 1;
      along_[n] = n == root ? 0 : along_[parent_[n]] + significance(forest_, n, parent_[n]);
    }
    for (auto n = tree.order.rbegin(); n != tree.order.rend(); ++n) gather_leaves(*n, root);
    keep_[root] = 1;
    for (NodeId leaf = leaves_.first(root); leaf != kNone; leaf = leaves_.next(leaf))
      for (NodeId k = leaf; !keep_[k]; k = parent_[k]) keep_[k] = 1;
  }

  void gather_leaves(NodeId n, NodeId root) {
    const std::size_t degree = forest_.degree(n);
    if (degree == 1 && n != root) leaves_.add(n, n);
    if (degree > 2) keep_at_joint(n);
    if (n != root) leaves_.join(parent_[n], n);
  }

  void keep_at_joint(NodeId joint) {
    const auto leaves = leaves_.take(joint);
    const NodeId most_significant = *std::max_element(
        leaves.begin(), leaves.end(), [&](NodeId a, NodeId b) { return along_[a] < along_[b]; });
    for (const NodeId leaf : leaves)
      if (leaf == most_significant || leads_out(leaf, joint)) leaves_.add(joint, leaf);
  }

  bool is_outside(NodeId n, NodeId joint) const {
    return forest_.length(n, joint) >= forest_.node(n).radius + forest_.node(joint).radius;
  }

  bool leads_out(NodeId leaf, NodeId joint) const {
    if (zone_ == Zone::OfLeaves) return is_outside(leaf, joint);
    for (NodeId n = leaf; n != joint; n = parent_[n])
      if (is_outside(n, joint)) return true;
    return false;
  }

  LiveGraph forest_;
  Zone zone_;
  std::vector<NodeId> parent_;
  std::vector<double> along_;  // sum of significance from the root
  LeafSets leaves_;
  std::vector<std::uint8_t> visited_, keep_;
};

}  // namespace

VoteGraph prune_by_zone_of_influence(const VoteGraph& forest, Zone zone) {
  return ZonePruner(forest, zone).prune();
}

VoteGraph prune_to_convergence(VoteGraph forest) {
  for (std::size_t before = forest.nodes.size() + 1; forest.nodes.size() < before;) {
    before = forest.nodes.size();
    forest = prune_by_zone_of_influence(forest, Zone::OfLeaves);
  }
  return forest;
}

VoteGraph extract_perceptual_core(const VoteGraph& forest, double voxel) {
  return prune_leaves(prune_by_zone_of_influence(forest, Zone::OfWays), voxel);
}

}  // namespace marrow
