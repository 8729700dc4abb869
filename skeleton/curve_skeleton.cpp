#include <marrow/curve_skeleton.hpp>
#include <marrow/disjoint_sets.hpp>

#include <algorithm>
#include <numeric>

namespace marrow {

namespace {

/// Edges at every node, as one array with offsets.
struct Incidence {
  std::vector<std::uint32_t> offset, edge;

  Incidence(std::size_t nodes, std::span<const CurveSkeleton::Edge> edges)
      : offset(nodes + 1), edge(2 * edges.size()) {
    for (const auto& e : edges) ++offset[e[0] + 1], ++offset[e[1] + 1];
    std::partial_sum(offset.begin(), offset.end(), offset.begin());
    std::vector<std::uint32_t> next(offset.begin(), offset.end() - 1);
    for (std::uint32_t i = 0; i < edges.size(); ++i)
      for (const NodeId n : edges[i]) edge[next[n]++] = i;
  }

  std::uint32_t degree(NodeId n) const { return offset[n + 1] - offset[n]; }
};

NodeId other_end(const CurveSkeleton::Edge& e, NodeId n) { return e[0] == n ? e[1] : e[0]; }

}  // namespace

std::vector<int> degrees(const CurveSkeleton& skeleton) {
  std::vector<int> degree(skeleton.nodes.size(), 0);
  for (const auto& e : skeleton.edges) ++degree[e[0]], ++degree[e[1]];
  return degree;
}

std::vector<std::vector<NodeId>> neighbours_of(const CurveSkeleton& skeleton) {
  std::vector<std::vector<NodeId>> result(skeleton.nodes.size());
  for (const auto& e : skeleton.edges) {
    result[e[0]].push_back(e[1]);
    result[e[1]].push_back(e[0]);
  }
  for (auto& list : result) std::sort(list.begin(), list.end());
  return result;
}

std::vector<std::uint32_t> component_of_nodes(const CurveSkeleton& skeleton) {
  DisjointSets parts(skeleton.nodes.size());
  for (const auto& [a, b] : skeleton.edges) parts.join(a, b);
  std::vector<std::uint32_t> part(parts.size());
  std::uint32_t count = 0;
  // The root is the first node of its part.
  for (NodeId n = 0; n < part.size(); ++n)
    part[n] = parts.root(n) == n ? count++ : part[parts.root(n)];
  return part;
}

int component_count(const CurveSkeleton& skeleton) {
  DisjointSets parts(skeleton.nodes.size());
  for (const auto& e : skeleton.edges) parts.join(e[0], e[1]);
  return static_cast<int>(parts.count());
}

int cycle_count(const CurveSkeleton& skeleton) {
  return static_cast<int>(skeleton.edges.size()) - static_cast<int>(skeleton.nodes.size()) +
         component_count(skeleton);
}

int leaf_count(const CurveSkeleton& skeleton) {
  const auto degree = degrees(skeleton);
  return static_cast<int>(std::count(degree.begin(), degree.end(), 1));
}

int joint_count(const CurveSkeleton& skeleton) {
  const auto degree = degrees(skeleton);
  return static_cast<int>(std::count_if(degree.begin(), degree.end(), [](int d) { return d > 2; }));
}

double total_length(const CurveSkeleton& skeleton) {
  double sum = 0;
  for (const auto& e : skeleton.edges)
    sum += distance(skeleton.nodes[e[0]].position, skeleton.nodes[e[1]].position);
  return sum;
}

std::vector<Branch> branches(const CurveSkeleton& skeleton) {
  return branches(skeleton.nodes.size(), skeleton.edges);
}

std::vector<Branch> branches(std::size_t nodes, std::span<const CurveSkeleton::Edge> edges) {
  const Incidence at(nodes, edges);
  std::vector<bool> used(edges.size(), false);
  std::vector<Branch> result;

  const auto walk = [&](NodeId from, std::uint32_t first) {
    Branch branch{{from}};
    for (std::uint32_t e = first;;) {
      used[e] = true;
      const NodeId n = other_end(edges[e], branch.nodes.back());
      branch.nodes.push_back(n);
      if (n == from || at.degree(n) != 2) break;
      const std::uint32_t a = at.edge[at.offset[n]], b = at.edge[at.offset[n] + 1];
      e = a == e ? b : a;
    }
    result.push_back(std::move(branch));
  };

  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (const NodeId n : edges[e])
      if (!used[e] && at.degree(n) != 2) walk(n, e);
  // What is left are cycles without a joint.
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (!used[e]) walk(edges[e][0], e);
  return result;
}

std::vector<std::uint32_t> branch_of_edges(const CurveSkeleton& skeleton) {
  std::vector<std::uint32_t> branch_of(skeleton.edges.size());
  std::uint32_t id = 0;
  for (const Branch& branch : branches(skeleton)) {
    for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
      const auto [a, b] = std::minmax(branch.nodes[i - 1], branch.nodes[i]);
      const auto edge =
          std::lower_bound(skeleton.edges.begin(), skeleton.edges.end(), CurveSkeleton::Edge{a, b});
      branch_of[static_cast<std::size_t>(edge - skeleton.edges.begin())] = id;
    }
    ++id;
  }
  return branch_of;
}

double length_of(const CurveSkeleton& skeleton, const Branch& branch) {
  double sum = 0;
  for (std::size_t i = 1; i < branch.nodes.size(); ++i)
    sum += distance(skeleton.nodes[branch.nodes[i - 1]].position,
                    skeleton.nodes[branch.nodes[i]].position);
  return sum;
}

}  // namespace marrow
