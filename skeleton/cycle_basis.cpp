#include <marrow/curve_skeleton.hpp>

#include <algorithm>
#include <limits>

namespace marrow {

namespace {

constexpr NodeId kNone = std::numeric_limits<NodeId>::max();

struct Tree {
  std::vector<NodeId> parent;        ///< kNone: the first node of a part
  std::vector<std::uint32_t> depth;  ///< steps from there
};

Tree breadth_first_tree(const CurveSkeleton& skeleton) {
  const auto neighbours = neighbours_of(skeleton);
  const std::size_t count = neighbours.size();
  Tree tree{std::vector<NodeId>(count, kNone), std::vector<std::uint32_t>(count, 0)};
  std::vector<bool> is_seen(count, false);
  std::vector<NodeId> queue;
  for (NodeId first = 0; first < count; ++first) {
    if (is_seen[first]) continue;
    is_seen[first] = true;
    queue.assign(1, first);
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const NodeId n : neighbours[queue[i]]) {
        if (is_seen[n]) continue;
        is_seen[n] = true;
        tree.parent[n] = queue[i];
        tree.depth[n] = tree.depth[queue[i]] + 1;
        queue.push_back(n);
      }
  }
  return tree;
}

/// From a up to where the ways meet, down to b, and back to a.
Branch close_cycle(const Tree& tree, NodeId a, NodeId b) {
  std::vector<NodeId> up{a}, down{b};
  while (up.back() != down.back()) {
    auto& deeper = tree.depth[up.back()] >= tree.depth[down.back()] ? up : down;
    deeper.push_back(tree.parent[deeper.back()]);
  }
  up.insert(up.end(), down.rbegin() + 1, down.rend());
  up.push_back(a);
  return {std::move(up)};
}

}  // namespace

std::vector<Branch> cycle_basis(const CurveSkeleton& skeleton) {
  const Tree tree = breadth_first_tree(skeleton);
  std::vector<Branch> cycles;
  for (const auto& [a, b] : skeleton.edges)
    if (tree.parent[a] != b && tree.parent[b] != a) cycles.push_back(close_cycle(tree, a, b));
  return cycles;
}

}  // namespace marrow
