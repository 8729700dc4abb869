#include <marrow/error.hpp>
#include <marrow/prune.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marrow {

namespace {

/// A branch from a joint to a leaf.
struct EndBranch {
  std::vector<NodeId> nodes;  ///< the joint first
  double length = 0;
  double radius = 0;  ///< mean along the length
};

double mean_radius(const CurveSkeleton& skeleton, const Branch& branch, double length) {
  double sum = 0;
  for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
    const auto &a = skeleton.nodes[branch.nodes[i - 1]], &b = skeleton.nodes[branch.nodes[i]];
    sum += distance(a.position, b.position) * (a.radius + b.radius) / 2;
  }
  return length > 0 ? sum / length : skeleton.nodes[branch.nodes.back()].radius;
}

/// The end branches that are too small, the shortest first.
std::vector<EndBranch> small_branches(const CurveSkeleton& skeleton, const PruneOptions& options) {
  const std::vector<int> degree = degrees(skeleton);
  std::vector<EndBranch> small;
  for (Branch& branch : branches(skeleton)) {
    if (degree[branch.nodes.front()] == 1) std::reverse(branch.nodes.begin(), branch.nodes.end());
    if (degree[branch.nodes.front()] < 3 || degree[branch.nodes.back()] != 1) continue;
    EndBranch end{{}, length_of(skeleton, branch), 0};
    end.radius = mean_radius(skeleton, branch, end.length);
    end.nodes = std::move(branch.nodes);
    if (end.length < options.length || end.radius < options.radius) small.push_back(std::move(end));
  }
  std::stable_sort(small.begin(), small.end(),
                   [](const EndBranch& a, const EndBranch& b) { return a.length < b.length; });
  return small;
}

/// Without the nodes that are marked and the edges at them.
CurveSkeleton without(const CurveSkeleton& skeleton, const std::vector<bool>& is_gone) {
  CurveSkeleton result;
  std::vector<NodeId> id(skeleton.nodes.size());
  for (NodeId n = 0; n < id.size(); ++n) {
    id[n] = static_cast<NodeId>(result.nodes.size());
    if (!is_gone[n]) result.nodes.push_back(skeleton.nodes[n]);
  }
  for (const auto& [a, b] : skeleton.edges)
    if (!is_gone[a] && !is_gone[b]) result.edges.push_back({id[a], id[b]});
  return result;
}

void check(const PruneOptions& options) {
  for (const double limit : {options.length, options.radius})
    if (!(limit >= 0) || !std::isfinite(limit))
      throw Error(ErrorKind::Usage, "a limit for pruning is not 0 or more");
}

}  // namespace

CurveSkeleton prune(const CurveSkeleton& skeleton, const PruneOptions& options) {
  check(options);
  CurveSkeleton result = skeleton;
  for (;;) {
    const std::vector<EndBranch> small = small_branches(result, options);
    if (small.empty()) return result;
    std::vector<int> degree = degrees(result);
    std::vector<bool> is_gone(result.nodes.size(), false);
    for (const EndBranch& end : small) {
      // A joint that is none any more joins two branches, which the next round judges as one.
      if (degree[end.nodes.front()] < 3) continue;
      --degree[end.nodes.front()];
      for (std::size_t i = 1; i < end.nodes.size(); ++i) is_gone[end.nodes[i]] = true;
    }
    result = without(result, is_gone);
  }
}

}  // namespace marrow
