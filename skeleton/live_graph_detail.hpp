// A VoteGraph that nodes and edges can be taken out of.
#pragma once

#include <marrow/vote_graph.hpp>

#include <span>

namespace marrow {

/// Neighbours in one array; what is removed moves behind the end of its node's part.
class LiveGraph {
 public:
  explicit LiveGraph(const VoteGraph& graph);

  const VoteGraph::Node& node(NodeId n) const { return graph_.nodes[n]; }
  std::size_t size() const { return graph_.nodes.size(); }
  bool alive(NodeId n) const { return alive_[n] != 0; }
  std::size_t degree(NodeId n) const { return degree_[n]; }
  std::span<const NodeId> neighbours(NodeId n) const {
    return std::span(neighbour_).subspan(start_[n], degree_[n]);
  }
  double length(NodeId a, NodeId b) const { return distance(node(a).position, node(b).position); }

  void remove_edge(NodeId a, NodeId b);
  void remove_node(NodeId n);

  /// What is left, renumbered in the old order.
  VoteGraph result() const;

 private:
  void forget(NodeId at, NodeId neighbour);

  const VoteGraph& graph_;
  std::vector<std::uint32_t> start_, degree_;
  std::vector<NodeId> neighbour_;
  std::vector<std::uint8_t> alive_;
};

/// A leaf branch: its nodes from the leaf on, without the joint it ends at.
struct LeafBranch {
  std::vector<NodeId> nodes;
  NodeId joint = 0;
  bool ends_at_joint = false;  ///< false: the whole part is one path

  NodeId leaf() const { return nodes.front(); }
};

/// Walks from a leaf (degree 1) to the first joint.
LeafBranch trace_leaf_branch(const LiveGraph& graph, NodeId leaf);

}  // namespace marrow
