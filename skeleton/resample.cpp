#include <marrow/error.hpp>
#include <marrow/resample.hpp>

#include <algorithm>
#include <cmath>

#include "branch_chains_detail.hpp"

namespace marrow {

namespace {

using skeleton_detail::between;
using Node = CurveSkeleton::Node;

constexpr double kMostNodes = 1e8;

/// A branch with the steps that its nodes are from its beginning.
struct Measured {
  std::vector<Node> nodes;
  std::vector<double> steps;
};

/// `steps_of` tells how many steps an edge takes; they count evenly along it.
template <class StepsOf>
Measured measure(const CurveSkeleton& skeleton, const Branch& branch, StepsOf steps_of) {
  Measured measured;
  for (const NodeId n : branch.nodes) {
    const Node& node = skeleton.nodes[n];
    const double before = measured.steps.empty() ? 0 : measured.steps.back();
    measured.steps.push_back(
        measured.nodes.empty() ? 0 : before + steps_of(measured.nodes.back(), node));
    measured.nodes.push_back(node);
  }
  return measured;
}

std::size_t pieces_of(const Measured& branch, std::size_t least_inner) {
  const double steps = branch.steps.back();
  if (!(steps < kMostNodes))
    throw Error(ErrorKind::Limit, "the spacing is too small for the length of a branch; raise it");
  return std::max(least_inner + 1, static_cast<std::size_t>(std::floor(steps + 0.5)));
}

/// The nodes within a branch that part it into equal pieces.
std::vector<Node> inner_nodes(const Measured& branch, std::size_t pieces) {
  std::vector<Node> inner;
  std::size_t edge = 1;
  for (std::size_t i = 1; i < pieces; ++i) {
    const double at = branch.steps.back() * static_cast<double>(i) / static_cast<double>(pieces);
    while (edge + 1 < branch.steps.size() && branch.steps[edge] < at) ++edge;
    const double begin = branch.steps[edge - 1], length = branch.steps[edge] - begin;
    const double t = length > 0 ? std::clamp((at - begin) / length, 0.0, 1.0) : 0;
    inner.push_back(between(branch.nodes[edge - 1], branch.nodes[edge], t));
  }
  return inner;
}

/// The nodes that end a branch or are alone, in their order, and where they are among them.
struct Ends {
  std::vector<Node> nodes;
  std::vector<NodeId> id;
};

Ends ends_of(const CurveSkeleton& skeleton, const std::vector<Branch>& all) {
  std::vector<bool> is_end(skeleton.nodes.size(), false);
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < degree.size(); ++n) is_end[n] = degree[n] == 0;
  for (const Branch& branch : all)
    is_end[branch.nodes.front()] = is_end[branch.nodes.back()] = true;
  Ends ends{{}, std::vector<NodeId>(skeleton.nodes.size())};
  for (NodeId n = 0; n < degree.size(); ++n) {
    ends.id[n] = static_cast<NodeId>(ends.nodes.size());
    if (is_end[n]) ends.nodes.push_back(skeleton.nodes[n]);
  }
  return ends;
}

template <class StepsOf>
CurveSkeleton resampled(const CurveSkeleton& skeleton, StepsOf steps_of) {
  const std::vector<Branch> all = branches(skeleton);
  const std::vector<std::size_t> least = skeleton_detail::least_inner_nodes(all);
  const Ends ends = ends_of(skeleton, all);
  CurveSkeleton result{ends.nodes, {}};
  std::vector<Branch> chains;
  for (std::size_t b = 0; b < all.size(); ++b) {
    const Measured measured = measure(skeleton, all[b], steps_of);
    const std::size_t pieces = pieces_of(measured, least[b]);
    if (static_cast<double>(result.nodes.size() + pieces) > kMostNodes)
      throw Error(ErrorKind::Limit, "the spacing is too small for the skeleton; raise it");
    Branch chain{{ends.id[all[b].nodes.front()]}};
    for (const Node& node : inner_nodes(measured, pieces)) {
      chain.nodes.push_back(static_cast<NodeId>(result.nodes.size()));
      result.nodes.push_back(node);
    }
    chain.nodes.push_back(ends.id[all[b].nodes.back()]);
    chains.push_back(std::move(chain));
  }
  result.edges = skeleton_detail::edges_along(chains);
  return result;
}

void check_spacing(double spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw Error(ErrorKind::Usage, "the spacing of nodes is not greater than 0");
}

}  // namespace

CurveSkeleton resample(const CurveSkeleton& skeleton, double spacing) {
  check_spacing(spacing);
  return resampled(skeleton, [&](const Node& a, const Node& b) {
    return distance(a.position, b.position) / spacing;
  });
}

CurveSkeleton resample_by_radius(const CurveSkeleton& skeleton, double share) {
  check_spacing(share);
  return resampled(skeleton, [&](const Node& a, const Node& b) {
    return distance(a.position, b.position) / (share * ((a.radius + b.radius) / 2));
  });
}

}  // namespace marrow
