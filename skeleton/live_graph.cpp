#include <algorithm>
#include <numeric>

#include "live_graph_detail.hpp"

namespace marrow {

LiveGraph::LiveGraph(const VoteGraph& graph)
    : graph_(graph),
      start_(graph.nodes.size() + 1, 0),
      degree_(graph.nodes.size(), 0),
      neighbour_(2 * graph.edges.size()),
      alive_(graph.nodes.size(), 1) {
  for (const auto& [a, b] : graph.edges) ++start_[a + 1], ++start_[b + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  for (const auto& [a, b] : graph.edges) {
    neighbour_[start_[a] + degree_[a]++] = b;
    neighbour_[start_[b] + degree_[b]++] = a;
  }
}

void LiveGraph::forget(NodeId at, NodeId neighbour) {
  const auto first = neighbour_.begin() + start_[at], last = first + degree_[at];
  const auto found = std::find(first, last, neighbour);
  if (found == last) return;
  std::rotate(found, found + 1, last);  // keeps the order of the others
  --degree_[at];
}

void LiveGraph::remove_edge(NodeId a, NodeId b) {
  forget(a, b);
  forget(b, a);
}

void LiveGraph::remove_node(NodeId n) {
  for (const NodeId m : neighbours(n)) forget(m, n);
  degree_[n] = 0;
  alive_[n] = 0;
}

VoteGraph LiveGraph::result() const {
  VoteGraph out;
  std::vector<NodeId> renumbered(size());
  for (NodeId n = 0; n < size(); ++n) {
    if (!alive(n)) continue;
    renumbered[n] = static_cast<NodeId>(out.nodes.size());
    out.nodes.push_back(node(n));
  }
  for (NodeId n = 0; n < size(); ++n)
    for (const NodeId m : neighbours(n))
      if (n < m) out.edges.push_back({renumbered[n], renumbered[m]});
  std::sort(out.edges.begin(), out.edges.end());
  return out;
}

LeafBranch trace_leaf_branch(const LiveGraph& graph, NodeId leaf) {
  LeafBranch branch;
  NodeId previous = leaf, here = leaf;
  do {
    branch.nodes.push_back(here);
    NodeId next = here;
    for (const NodeId n : graph.neighbours(here))
      if (n != previous) next = n;
    if (next == here) return branch;  // the other leaf
    previous = here;
    here = next;
  } while (graph.degree(here) <= 2);
  branch.joint = here;
  branch.ends_at_joint = true;
  return branch;
}

}  // namespace marrow
