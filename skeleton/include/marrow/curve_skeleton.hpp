// The curve-skeleton: a graph of centre lines with the radius of a ball at every node.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

using NodeId = std::uint32_t;

/// A graph of centre lines. A leaf has one edge, a joint three or more; a branch is a chain of
/// nodes between two of them (section 3 of the paper). No self edges, no duplicate edges.
struct CurveSkeleton {
  struct Node {
    Vec3 position;      ///< in the units of the shape
    double radius = 0;  ///< of the inscribed ball at this node, > 0, in the units of the shape
    double section_radius = 0;  ///< of the ball that stands for the section, >= radius; 0: unknown

    friend bool operator==(const Node&, const Node&) = default;
  };
  using Edge = std::array<NodeId, 2>;  ///< lower id first

  std::vector<Node> nodes;
  std::vector<Edge> edges;  ///< sorted

  friend bool operator==(const CurveSkeleton&, const CurveSkeleton&) = default;
};

/// A chain of nodes from a leaf or joint to the next; a cycle without a joint repeats its first
/// node.
struct Branch {
  std::vector<NodeId> nodes;

  bool is_closed() const { return nodes.size() > 1 && nodes.front() == nodes.back(); }
};

/// Number of edges at every node.
std::vector<int> degrees(const CurveSkeleton& skeleton);

/// Neighbours of every node, in the order of their ids.
std::vector<std::vector<NodeId>> neighbours_of(const CurveSkeleton& skeleton);

/// The connected piece of every node, counted from 0 in the order of their first nodes.
std::vector<std::uint32_t> component_of_nodes(const CurveSkeleton& skeleton);

/// Connected pieces.
int component_count(const CurveSkeleton& skeleton);

/// Independent cycles: edges - nodes + components.
int cycle_count(const CurveSkeleton& skeleton);

/// Nodes with exactly one edge.
int leaf_count(const CurveSkeleton& skeleton);

/// Nodes with three edges or more.
int joint_count(const CurveSkeleton& skeleton);

/// Sum of the lengths of all edges.
double total_length(const CurveSkeleton& skeleton);

/// All branches: first those that end at a leaf or joint, then cycles without one, each group in
/// the order of its first edge.
std::vector<Branch> branches(const CurveSkeleton& skeleton);
/// The same for any graph of `nodes` nodes.
std::vector<Branch> branches(std::size_t nodes, std::span<const CurveSkeleton::Edge> edges);

/// The index of every edge's branch in branches().
std::vector<std::uint32_t> branch_of_edges(const CurveSkeleton& skeleton);

/// Sum of the lengths of its edges.
double length_of(const CurveSkeleton& skeleton, const Branch& branch);

/// cycle_count() independent cycles, of which all others are sums: for every edge that closes one,
/// in their order, the way back through a breadth-first tree. Each repeats its first node.
std::vector<Branch> cycle_basis(const CurveSkeleton& skeleton);

}  // namespace marrow
