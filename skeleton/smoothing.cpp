#include <marrow/smoothing.hpp>

#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr int kTipSupport = kImages / 2;
constexpr double kVoxelsBeyond = 2;
constexpr double kDetour = 2;  // along a hook, times across

/// How far from its leaf a branch is still its end.
double reach_of_end(const LiveGraph& graph, const LeafBranch& branch, double voxel) {
  return graph.node(branch.leaf()).radius + kVoxelsBeyond * voxel;
}

void trim_branch(LiveGraph& graph, const LeafBranch& branch, double voxel) {
  const double most = reach_of_end(graph, branch, voxel);
  double trimmed = 0;
  for (std::size_t i = 0; i + 1 < branch.nodes.size(); ++i) {
    if (graph.node(branch.nodes[i]).support >= kTipSupport) return;
    trimmed += graph.length(branch.nodes[i], branch.nodes[i + 1]);
    if (trimmed > most) return;
    graph.remove_node(branch.nodes[i]);
  }
}

/// The leaves of the whole graph: where a branch was cut is no new leaf.
std::vector<NodeId> leaves_of(const LiveGraph& graph) {
  std::vector<NodeId> leaves;
  for (NodeId n = 0; n < graph.size(); ++n)
    if (graph.degree(n) == 1) leaves.push_back(n);
  return leaves;
}

bool balls_overlap(const LiveGraph& graph, NodeId a, NodeId b, double voxel) {
  return graph.length(a, b) + voxel < graph.node(a).radius + graph.node(b).radius;
}

/// The place along the branch of the node furthest along that the leaf comes back to; 0: none.
std::size_t place_passed_twice(const LiveGraph& graph, const LeafBranch& branch, double voxel) {
  std::size_t last = 0;
  double along = 0;
  for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
    along += graph.length(branch.nodes[i - 1], branch.nodes[i]);
    const double across = graph.length(branch.leaf(), branch.nodes[i]);
    const bool is_detour = along > kDetour * across + kVoxelsBeyond * voxel;
    if (is_detour && balls_overlap(graph, branch.leaf(), branch.nodes[i], voxel)) last = i;
  }
  return last;
}

/// The place of the turn between the leaf and what it comes back to.
std::size_t turn_before(const LiveGraph& graph, const LeafBranch& branch, std::size_t passed) {
  std::size_t turn = 0;
  double furthest = 0;
  for (std::size_t i = 0; i < passed; ++i) {
    const double across = graph.length(branch.nodes[i], branch.nodes[passed]);
    if (across > furthest) furthest = across, turn = i;
  }
  return turn;
}

bool runs_into_rest(const LiveGraph& graph, const LeafBranch& branch, std::size_t place,
                    std::size_t rest, double voxel) {
  for (std::size_t i = rest; i < branch.nodes.size(); ++i)
    if (balls_overlap(graph, branch.nodes[place], branch.nodes[i], voxel)) return true;
  return false;
}

void cut_hook(LiveGraph& graph, const LeafBranch& branch, double voxel) {
  const std::size_t passed = place_passed_twice(graph, branch, voxel);
  if (passed == 0) return;
  const std::size_t turn = turn_before(graph, branch, passed);
  const double depth = graph.length(branch.leaf(), branch.nodes[turn]);
  if (depth < reach_of_end(graph, branch, voxel)) return;  // an end that bends
  for (std::size_t i = 0; i < turn; ++i)
    if (!runs_into_rest(graph, branch, i, turn, voxel)) return;
  for (std::size_t i = 0; i < turn; ++i) graph.remove_node(branch.nodes[i]);
}

}  // namespace

VoteGraph cut_hooks(const VoteGraph& graph, double voxel) {
  LiveGraph live(graph);
  for (const NodeId n : leaves_of(live))
    if (live.alive(n) && live.degree(n) == 1) cut_hook(live, trace_leaf_branch(live, n), voxel);
  return live.result();
}

VoteGraph trim_leaves(const VoteGraph& graph, double voxel) {
  LiveGraph live(graph);
  for (const NodeId n : leaves_of(live)) {
    if (!live.alive(n) || live.degree(n) != 1) continue;
    LeafBranch branch = trace_leaf_branch(live, n);
    // A part that is a single path keeps its middle.
    if (!branch.ends_at_joint) branch.nodes.resize((branch.nodes.size() + 1) / 2);
    trim_branch(live, branch, voxel);
  }
  return live.result();
}

VoteGraph smooth_branches(VoteGraph graph, int passes) {
  const LiveGraph live(graph);
  std::vector<Vec3> moved(graph.nodes.size());
  for (int pass = 0; pass < passes; ++pass) {
    for (NodeId n = 0; n < moved.size(); ++n) {
      moved[n] = graph.nodes[n].position;
      if (live.degree(n) != 2) continue;
      const auto around = live.neighbours(n);
      const Vec3 middle = (graph.nodes[around[0]].position + graph.nodes[around[1]].position) * 0.5;
      moved[n] = (moved[n] + middle) * 0.5;
    }
    for (NodeId n = 0; n < moved.size(); ++n) graph.nodes[n].position = moved[n];
  }
  return graph;
}

}  // namespace marrow
