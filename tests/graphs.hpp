// Graphs made by hand, and meshes to ask about them, in the normalised frame.
#pragma once

#include <marrow/normalization.hpp>
#include <marrow/vote_graph.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace marrow::test {

/// What the nodes of a line have in common.
struct Pen {
  double step = 0.02;
  double radius = 0.05;
  int support = 42;
};

inline NodeId add_node(VoteGraph& graph, const Vec3& position, const Pen& pen) {
  graph.nodes.push_back({position, pen.radius, pen.support, pen.support, 0});
  return static_cast<NodeId>(graph.nodes.size() - 1);
}

inline void add_edge(VoteGraph& graph, NodeId a, NodeId b) {
  graph.edges.push_back({std::min(a, b), std::max(a, b)});
}

/// Nodes from `from` to `to` about a step apart, both ends left out, and the edges between all.
inline void join(VoteGraph& graph, NodeId from, NodeId to, const Pen& pen) {
  const Vec3 a = graph.nodes[from].position, b = graph.nodes[to].position;
  const int pieces = std::max(1, static_cast<int>(std::lround(distance(a, b) / pen.step)));
  NodeId last = from;
  for (int i = 1; i < pieces; ++i) {
    const NodeId next = add_node(graph, a + (b - a) * (double(i) / pieces), pen);
    add_edge(graph, last, next);
    last = next;
  }
  add_edge(graph, last, to);
}

/// A straight line to a new node, whose id it returns.
inline NodeId draw(VoteGraph& graph, NodeId from, const Vec3& to, const Pen& pen) {
  const NodeId end = add_node(graph, to, pen);
  join(graph, from, end, pen);
  return end;
}

/// The graph as a skeleton: for counts.
inline CurveSkeleton counts_of(const VoteGraph& graph) {
  CurveSkeleton skeleton;
  for (const auto& n : graph.nodes) skeleton.nodes.push_back({n.position, n.radius});
  skeleton.edges = graph.edges;
  return skeleton;
}

/// Index of the node nearest to `p`.
inline NodeId nearest_node(const VoteGraph& graph, const Vec3& p) {
  NodeId best = 0;
  for (NodeId i = 0; i < graph.nodes.size(); ++i)
    if (distance(graph.nodes[i].position, p) < distance(graph.nodes[best].position, p)) best = i;
  return best;
}

inline bool has_node_at(const VoteGraph& graph, const Vec3& p, double reach = 1e-9) {
  return !graph.nodes.empty() && distance(graph.nodes[nearest_node(graph, p)].position, p) <= reach;
}

/// Adds the twelve triangles of a box to a mesh, outward.
inline void add_box(Shape& shape, const Vec3& low, const Vec3& high) {
  const auto base = static_cast<std::uint32_t>(shape.points.size());
  for (std::uint32_t i = 0; i < 8; ++i)
    shape.points.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    shape.triangles.push_back({base + f[0], base + f[1], base + f[2]});
    shape.triangles.push_back({base + f[0], base + f[2], base + f[3]});
  }
}

inline Shape box(const Vec3& low, const Vec3& high) {
  Shape shape;
  add_box(shape, low, high);
  return shape;
}

/// The shape as it is, without a change of frame.
inline NormalizedShape as_normalized(const Shape& shape) {
  NormalizedShape n;
  for (const auto& p : shape.points) {
    n.x.push_back(static_cast<float>(p.x));
    n.y.push_back(static_cast<float>(p.y));
    n.z.push_back(static_cast<float>(p.z));
  }
  n.triangles = shape.triangles;
  n.low = {-1, -1, -1};
  n.high = {1, 1, 1};
  return n;
}

}  // namespace marrow::test
