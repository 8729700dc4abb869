#include <marrow/loop_recovery.hpp>

#include <algorithm>
#include <tuple>

#include "live_graph_detail.hpp"

namespace marrow {

namespace {

/// Two leaves whose balls meet; the nearer for their size, the sooner they are joined.
struct Meeting {
  double closeness;  // distance by the sum of the radii
  NodeId a, b;

  friend bool operator<(const Meeting& x, const Meeting& y) {
    return std::tie(x.closeness, x.a, x.b) < std::tie(y.closeness, y.a, y.b);
  }
};

std::vector<NodeId> leaves_of(const LiveGraph& graph) {
  std::vector<NodeId> leaves;
  for (NodeId n = 0; n < graph.size(); ++n)
    if (graph.degree(n) == 1) leaves.push_back(n);
  return leaves;
}

std::vector<Meeting> meetings(const LiveGraph& graph) {
  const std::vector<NodeId> leaves = leaves_of(graph);
  std::vector<Meeting> found;
  for (auto a = leaves.begin(); a != leaves.end(); ++a)
    for (auto b = a + 1; b != leaves.end(); ++b) {
      const double closeness =
          graph.length(*a, *b) / (graph.node(*a).radius + graph.node(*b).radius);
      const bool is_one_edge = graph.neighbours(*a)[0] == *b;
      if (closeness < 1 && !is_one_edge) found.push_back({closeness, *a, *b});
    }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

VoteGraph recover_loops(VoteGraph graph) {
  const std::vector<Meeting> found = meetings(LiveGraph(graph));
  std::vector<std::uint8_t> joined(graph.nodes.size(), 0);
  for (const Meeting& m : found) {
    if (joined[m.a] != 0 || joined[m.b] != 0) continue;
    joined[m.a] = joined[m.b] = 1;
    graph.edges.push_back({m.a, m.b});
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  return graph;
}

}  // namespace marrow
