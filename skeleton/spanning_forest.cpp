#include "spanning_forest_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

/// The thickest node of every part, the first of equals; parts in the order of their first nodes.
std::vector<NodeId> roots_of(const CurveSkeleton& skeleton) {
  const auto part = component_of_nodes(skeleton);
  std::vector<NodeId> roots;
  for (NodeId n = 0; n < part.size(); ++n) {
    if (part[n] == roots.size()) roots.push_back(n);
    NodeId& root = roots[part[n]];
    if (skeleton.nodes[n].radius > skeleton.nodes[root].radius) root = n;
  }
  return roots;
}

}  // namespace

SpanningForest spanning_forest(const CurveSkeleton& skeleton) {
  const auto neighbours = neighbours_of(skeleton);
  const std::size_t count = skeleton.nodes.size();
  SpanningForest forest{
      {}, std::vector<NodeId>(count, kNoParent), std::vector<std::uint64_t>(count, 0)};
  std::vector<std::uint32_t> next(count, 0);
  const auto visit = [&](NodeId n) {
    forest.order.push_back(n);
    forest.row[n] = forest.order.size();
  };
  for (const NodeId root : roots_of(skeleton)) {
    visit(root);
    for (NodeId n = root; n != kNoParent;) {
      if (next[n] == neighbours[n].size()) {
        n = forest.parent[n];
        continue;
      }
      const NodeId child = neighbours[n][next[n]++];
      if (forest.row[child] > 0) continue;
      forest.parent[child] = n;
      visit(child);
      n = child;
    }
  }
  return forest;
}

}  // namespace marrow::skeleton_detail
