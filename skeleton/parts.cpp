#include <marrow/parts.hpp>

#include <algorithm>
#include <iterator>

namespace marrow {

namespace {

std::vector<double> sizes_of(const CurveSkeleton& skeleton,
                             const std::vector<std::uint32_t>& part) {
  std::vector<double> size(
      part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + std::size_t{1}, 0.0);
  const std::vector<int> degree = degrees(skeleton);
  for (std::size_t n = 0; n < part.size(); ++n)
    if (degree[n] < 2) size[part[n]] += (2 - degree[n]) * skeleton.nodes[n].radius;
  for (const auto& [a, b] : skeleton.edges)
    size[part[a]] += distance(skeleton.nodes[a].position, skeleton.nodes[b].position);
  return size;
}

template <class Predicate>
CurveSkeleton nodes_that(const CurveSkeleton& skeleton, Predicate is_kept) {
  CurveSkeleton result;
  std::vector<NodeId> id(skeleton.nodes.size());
  for (NodeId n = 0; n < id.size(); ++n) {
    id[n] = static_cast<NodeId>(result.nodes.size());
    if (is_kept(n)) result.nodes.push_back(skeleton.nodes[n]);
  }
  // Renumbering keeps the order, also of the edges and within each.
  for (const auto& [a, b] : skeleton.edges)
    if (is_kept(a)) result.edges.push_back({id[a], id[b]});
  return result;
}

}  // namespace

std::vector<double> part_sizes(const CurveSkeleton& skeleton) {
  return sizes_of(skeleton, component_of_nodes(skeleton));
}

std::vector<CurveSkeleton> parts_of(const CurveSkeleton& skeleton) {
  const auto part = component_of_nodes(skeleton);
  std::vector<CurveSkeleton> parts;
  std::vector<NodeId> id(part.size());
  for (NodeId n = 0; n < part.size(); ++n) {
    if (part[n] == parts.size()) parts.emplace_back();
    auto& nodes = parts[part[n]].nodes;
    id[n] = static_cast<NodeId>(nodes.size());
    nodes.push_back(skeleton.nodes[n]);
  }
  for (const auto& [a, b] : skeleton.edges) parts[part[a]].edges.push_back({id[a], id[b]});
  return parts;
}

CurveSkeleton largest_part(const CurveSkeleton& skeleton) {
  const auto part = component_of_nodes(skeleton);
  const auto size = sizes_of(skeleton, part);
  const auto largest = std::distance(size.begin(), std::max_element(size.begin(), size.end()));
  return nodes_that(skeleton,
                    [&](NodeId n) { return part[n] == static_cast<std::size_t>(largest); });
}

CurveSkeleton large_parts(const CurveSkeleton& skeleton, double share) {
  const auto part = component_of_nodes(skeleton);
  const auto size = sizes_of(skeleton, part);
  const double least = size.empty() ? 0 : share * *std::max_element(size.begin(), size.end());
  return nodes_that(skeleton, [&](NodeId n) { return size[part[n]] >= least; });
}

}  // namespace marrow
