#include <algorithm>
#include <map>
#include <utility>

#include "branch_chains_detail.hpp"

namespace marrow::skeleton_detail {

std::vector<std::size_t> least_inner_nodes(const std::vector<Branch>& branches) {
  std::map<std::pair<NodeId, NodeId>, int> count;
  const auto ends_of = [](const Branch& branch) {
    return std::pair{std::min(branch.nodes.front(), branch.nodes.back()),
                     std::max(branch.nodes.front(), branch.nodes.back())};
  };
  for (const Branch& branch : branches) ++count[ends_of(branch)];
  std::vector<std::size_t> least;
  for (const Branch& branch : branches)
    least.push_back(branch.is_closed() ? 2 : count[ends_of(branch)] > 1 ? 1 : 0);
  return least;
}

std::vector<CurveSkeleton::Edge> edges_along(const std::vector<Branch>& chains) {
  std::vector<CurveSkeleton::Edge> edges;
  for (const Branch& chain : chains)
    for (std::size_t i = 1; i < chain.nodes.size(); ++i)
      edges.push_back({std::min(chain.nodes[i - 1], chain.nodes[i]),
                       std::max(chain.nodes[i - 1], chain.nodes[i])});
  std::sort(edges.begin(), edges.end());
  return edges;
}

CurveSkeleton::Node between(const CurveSkeleton::Node& a, const CurveSkeleton::Node& b, double t) {
  CurveSkeleton::Node node{a.position + (b.position - a.position) * t,
                           a.radius + (b.radius - a.radius) * t};
  if (a.section_radius > 0 && b.section_radius > 0)
    node.section_radius =
        std::max(node.radius, a.section_radius + (b.section_radius - a.section_radius) * t);
  return node;
}

}  // namespace marrow::skeleton_detail
