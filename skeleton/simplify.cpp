#include <marrow/error.hpp>
#include <marrow/simplify.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "branch_chains_detail.hpp"

namespace marrow {

namespace {

using Node = CurveSkeleton::Node;

/// How far `node` is from the line between two others, in place or in radius.
double error_of(const Node& node, const Node& from, const Node& to) {
  const Vec3 along = to.position - from.position;
  const double squared = squared_length(along);
  const double t =
      squared > 0 ? std::clamp(dot(node.position - from.position, along) / squared, 0.0, 1.0) : 0;
  const Node there = skeleton_detail::between(from, to, t);
  return std::max(distance(node.position, there.position), std::abs(node.radius - there.radius));
}

/// Some of the nodes of one branch, by their places in it.
class Selection {
 public:
  Selection(const CurveSkeleton& skeleton, const Branch& branch)
      : skeleton_(skeleton), branch_(branch), is_kept_(branch.nodes.size(), false) {
    is_kept_.front() = is_kept_.back() = true;
  }

  void keep_to(double tolerance) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, branch_.nodes.size() - 1}};
    while (!open.empty()) {
      const auto [first, last] = open.back();
      open.pop_back();
      const auto [place, error] = worst(first, last);
      if (place == 0 || error <= tolerance) continue;
      is_kept_[place] = true;
      open.push_back({first, place});
      open.push_back({place, last});
    }
  }

  /// Keeps the worst of the others until there are so many between the ends.
  void keep_at_least(std::size_t inner) {
    while (inner_count() < inner) {
      std::pair<std::size_t, double> most{0, -1};
      std::size_t first = 0;
      for (std::size_t i = 1; i < is_kept_.size(); ++i) {
        if (!is_kept_[i]) continue;
        const auto here = worst(first, i);
        if (here.first > 0 && here.second > most.second) most = here;
        first = i;
      }
      if (most.first == 0) return;
      is_kept_[most.first] = true;
    }
  }

  Branch kept() const {
    Branch result;
    for (std::size_t i = 0; i < is_kept_.size(); ++i)
      if (is_kept_[i]) result.nodes.push_back(branch_.nodes[i]);
    return result;
  }

 private:
  const Node& node(std::size_t place) const { return skeleton_.nodes[branch_.nodes[place]]; }

  std::size_t inner_count() const {
    return static_cast<std::size_t>(std::count(is_kept_.begin(), is_kept_.end(), true)) - 2;
  }

  /// The place between two that is farthest from the line between them, the first of equals; 0 if
  /// there is none.
  std::pair<std::size_t, double> worst(std::size_t first, std::size_t last) const {
    std::pair<std::size_t, double> most{0, -1};
    for (std::size_t i = first + 1; i < last; ++i) {
      const double error = error_of(node(i), node(first), node(last));
      if (error > most.second) most = {i, error};
    }
    return most;
  }

  const CurveSkeleton& skeleton_;
  const Branch& branch_;
  std::vector<bool> is_kept_;
};

}  // namespace

CurveSkeleton simplify(const CurveSkeleton& skeleton, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw Error(ErrorKind::Usage, "the tolerance of a simplification is not 0 or more");
  const std::vector<Branch> all = branches(skeleton);
  const std::vector<std::size_t> least = skeleton_detail::least_inner_nodes(all);
  const std::vector<int> degree = degrees(skeleton);
  std::vector<bool> is_kept(skeleton.nodes.size());
  for (NodeId n = 0; n < degree.size(); ++n) is_kept[n] = degree[n] == 0;
  std::vector<Branch> chains;
  for (std::size_t b = 0; b < all.size(); ++b) {
    Selection selection(skeleton, all[b]);
    selection.keep_to(tolerance);
    selection.keep_at_least(least[b]);
    chains.push_back(selection.kept());
    for (const NodeId n : chains.back().nodes) is_kept[n] = true;
  }
  CurveSkeleton result;
  std::vector<NodeId> id(skeleton.nodes.size());
  for (NodeId n = 0; n < id.size(); ++n) {
    id[n] = static_cast<NodeId>(result.nodes.size());
    if (is_kept[n]) result.nodes.push_back(skeleton.nodes[n]);
  }
  for (Branch& chain : chains)
    for (NodeId& n : chain.nodes) n = id[n];
  result.edges = skeleton_detail::edges_along(chains);
  return result;
}

}  // namespace marrow
