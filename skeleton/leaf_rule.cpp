#include <marrow/perceptual_core.hpp>

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "ball_grid_detail.hpp"
#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastScore = 0.36;
constexpr double kVoxelsBeyond = 2;
constexpr double kLeastRivalry = 0.6;  // support of a ball that may hold a node, of the node's
constexpr NodeId kNone = BallGrid::kNone;

class LeafPruner {
 public:
  LeafPruner(const VoteGraph& graph, double voxel)
      : graph_(graph),
        voxel_(voxel),
        balls_(graph, voxel),
        owner_(graph.nodes.size(), kNone),
        cover_(graph.nodes.size(), kNone),
        search_(graph.nodes.size()),
        first_served_(graph.nodes.size(), kNone),
        leaf_of_(graph.nodes.size(), kNone),
        score_(graph.nodes.size(), kNotWaiting) {}

  VoteGraph prune() {
    for (NodeId n = 0; n < graph_.size(); ++n)
      if (graph_.degree(n) == 1) consider(n);
    while (!waiting_.empty()) {
      const auto [score, leaf] = waiting_.top();
      waiting_.pop();
      if (score_[leaf] == score) remove(leaf);  // else it was judged again, or is gone
    }
    return graph_.result();
  }

 private:
  static constexpr double kNotWaiting = -1;

  /// Judges the branch of a leaf; it waits for its removal if it tells too little.
  void consider(NodeId leaf) {
    score_[leaf] = kNotWaiting;
    const LeafBranch branch = trace_leaf_branch(graph_, leaf);
    if (!branch.ends_at_joint) return;
    const auto [score, too_short] = judge(branch);
    for (const NodeId n : branch.nodes) leaf_of_[n] = leaf;
    if (!too_short && score >= kLeastScore) return;
    score_[leaf] = score;
    waiting_.push({score, leaf});
  }

  /// Removes the branch of a leaf, and judges those again that it mattered to: branches that its
  /// balls held, and those that now run on through its joint.
  void remove(NodeId leaf) {
    score_[leaf] = kNotWaiting;
    const LeafBranch branch = trace_leaf_branch(graph_, leaf);
    for (const NodeId n : branch.nodes) graph_.remove_node(n);
    std::vector<NodeId> again;
    for (const NodeId n : branch.nodes)
      for (std::uint32_t k = first_served_[n]; k != kNone; k = served_[k].next)
        if (graph_.alive(served_[k].node)) again.push_back(leaf_of_[served_[k].node]);
    if (graph_.degree(branch.joint) == 2)
      for (const NodeId n : graph_.neighbours(branch.joint)) again.push_back(leaf_of_[n]);
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    for (const NodeId other : again)
      if (other != kNone) consider(other);
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

  /// Whether a ball of the rest of the skeleton holds node `n` of a branch. The rest only shrinks
  /// and a branch only grows, so a ball found once serves until it is gone, and those passed over
  /// in the search need no second look.
  bool covered(NodeId n, const LeafBranch& branch) {
    if (cover_[n] != kNone && in_rest(cover_[n], branch)) return true;
    cover_[n] = find_cover(n, branch);
    if (cover_[n] == kNone) return false;
    served_.push_back({n, first_served_[cover_[n]]});
    first_served_[cover_[n]] = static_cast<std::uint32_t>(served_.size() - 1);
    return true;
  }

  NodeId find_cover(NodeId n, const LeafBranch& branch) {
    if (holds(branch.joint, n)) return branch.joint;
    for (;;) {
      const NodeId m = balls_.next(graph_.node(n).position, search_[n]);
      if (m == BallGrid::kNone || (holds(m, n) && in_rest(m, branch))) return m;
    }
  }

  /// A weakly supported path beside a strong one must not outdo it: its balls hold it, but do not
  /// count.
  bool holds(NodeId ball, NodeId n) const {
    const auto& b = graph_.node(ball);
    if (b.broad_support < kLeastRivalry * graph_.node(n).broad_support) return false;
    return squared_length(b.position - graph_.node(n).position) <= b.radius * b.radius;
  }

  bool in_rest(NodeId n, const LeafBranch& branch) const {
    return graph_.alive(n) && owner_[n] != branch.leaf();
  }

  /// An entry of a list of nodes; all lists share one array.
  struct Served {
    NodeId node;
    std::uint32_t next;
  };
  using Waiting = std::pair<double, NodeId>;

  LiveGraph graph_;
  double voxel_;
  BallGrid balls_;
  std::vector<NodeId> owner_;                // leaf of the branch being judged
  std::vector<NodeId> cover_;                // a node of the rest whose ball holds this one
  std::vector<BallGrid::Search> search_;     // where the search for a cover goes on
  std::vector<std::uint32_t> first_served_;  // nodes that this one was the cover of
  std::vector<Served> served_;
  std::vector<NodeId> leaf_of_;  // leaf of the branch this node was last judged in
  std::vector<double> score_;    // of waiting leaves
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

VoteGraph prune_leaves(const VoteGraph& graph, double voxel) {
  return LeafPruner(graph, voxel).prune();
}

}  // namespace marrow
