#include <marrow/smoothing.hpp>

#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr int kTipSupport = kImages / 2;
constexpr double kVoxelsBeyond = 2;

void trim_branch(LiveGraph& graph, const LeafBranch& branch, double voxel) {
  const double most = graph.node(branch.leaf()).radius + kVoxelsBeyond * voxel;
  double trimmed = 0;
  for (std::size_t i = 0; i + 1 < branch.nodes.size(); ++i) {
    if (graph.node(branch.nodes[i]).support >= kTipSupport) return;
    trimmed += graph.length(branch.nodes[i], branch.nodes[i + 1]);
    if (trimmed > most) return;
    graph.remove_node(branch.nodes[i]);
  }
}

}  // namespace

VoteGraph trim_leaves(const VoteGraph& graph, double voxel) {
  LiveGraph live(graph);
  std::vector<NodeId> leaves;  // of the whole graph: where a branch was trimmed is no new leaf
  for (NodeId n = 0; n < live.size(); ++n)
    if (live.degree(n) == 1) leaves.push_back(n);
  for (const NodeId n : leaves) {
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
