#include <marrow/perceptual_core.hpp>

#include <algorithm>

#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastScore = 0.36;
constexpr double kVoxelsBeyond = 2;
constexpr NodeId kNone = ~NodeId{0};

class LeafPruner {
 public:
  LeafPruner(const VoteGraph& graph, double voxel)
      : graph_(graph),
        voxel_(voxel),
        owner_(graph.nodes.size(), kNone),
        cover_(graph.nodes.size(), kUnknown) {}

  VoteGraph prune() {
    while (remove_least_telling()) {
    }
    return graph_.result();
  }

 private:
  static constexpr NodeId kUnknown = ~NodeId{0} - 1;

  bool remove_least_telling() {
    double least = 0;
    LeafBranch worst;
    for (NodeId n = 0; n < graph_.size(); ++n) {
      if (graph_.degree(n) != 1) continue;
      LeafBranch branch = trace_leaf_branch(graph_, n);
      if (!branch.ends_at_joint) continue;
      const auto [score, too_short] = judge(branch);
      if (!too_short && score >= kLeastScore) continue;
      if (worst.nodes.empty() || score < least) least = score, worst = std::move(branch);
    }
    for (const NodeId n : worst.nodes) graph_.remove_node(n);
    return !worst.nodes.empty();
  }

  struct Judgement {
    double score;
    bool too_short;
  };

  Judgement judge(const LeafBranch& branch) {
    for (const NodeId n : branch.nodes) owner_[n] = branch.leaf();
    double outside = 0, support = 0;
    for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
      const NodeId a = branch.nodes[i];
      const NodeId b = i + 1 < branch.nodes.size() ? branch.nodes[i + 1] : branch.joint;
      // Each node stands for half of the edges beside it; the joint is in its own ball.
      const double half = 0.5 * graph_.length(a, b);
      for (const NodeId n : {a, b}) {
        if (n == branch.joint || covered(n, branch)) continue;
        outside += half;
        support += half * graph_.node(n).broad_support;
      }
    }
    for (const NodeId n : branch.nodes) owner_[n] = kNone;
    const double unit = graph_.node(branch.leaf()).radius + kVoxelsBeyond * voxel_;
    const double mean = outside > 0 ? support / outside / kImages : 0;
    return {outside / unit * mean * mean * mean, outside < unit};
  }

  /// Whether a ball of the rest of the skeleton holds node `n` of a branch. The rest only shrinks,
  /// so what was found outside stays outside, and a ball found once serves until it is gone.
  bool covered(NodeId n, const LeafBranch& branch) {
    if (cover_[n] == kNone) return false;
    if (cover_[n] != kUnknown && in_rest(cover_[n], branch)) return true;
    cover_[n] = find_cover(n, branch);
    return cover_[n] != kNone;
  }

  NodeId find_cover(NodeId n, const LeafBranch& branch) const {
    if (holds(branch.joint, n)) return branch.joint;
    for (NodeId m = 0; m < graph_.size(); ++m)
      if (holds(m, n) && in_rest(m, branch)) return m;
    return kNone;
  }

  bool holds(NodeId ball, NodeId n) const {
    const auto& b = graph_.node(ball);
    return squared_length(b.position - graph_.node(n).position) <= b.radius * b.radius;
  }

  bool in_rest(NodeId n, const LeafBranch& branch) const {
    return graph_.alive(n) && owner_[n] != branch.leaf();
  }

  LiveGraph graph_;
  double voxel_;
  std::vector<NodeId> owner_;  // leaf of the branch being judged
  std::vector<NodeId> cover_;  // a node of the rest whose ball holds this one
};

}  // namespace

VoteGraph prune_leaves(const VoteGraph& graph, double voxel) {
  return LeafPruner(graph, voxel).prune();
}

}  // namespace marrow
