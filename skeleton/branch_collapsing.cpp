#include <marrow/branch_collapsing.hpp>

#include <algorithm>
#include <optional>
#include <tuple>

#include "branch_graph_detail.hpp"

namespace marrow {

namespace {

constexpr double kWeldVoxels = 6;
constexpr int kWeldSupport = kImages / 2;
constexpr double kShortestCycleVoxels = 12;

bool in_ball(const Vec3& p, const VoteGraph::Node& ball, double margin) {
  const double r = ball.radius + margin;
  return squared_length(p - ball.position) <= r * r;
}

/// d / (r1 + r2) of the two ends of a link, if they may merge.
std::optional<double> closeness(const BranchGraph& graph, const BranchGraph::Link& link,
                                double voxel) {
  if (!link.alive || link.a == link.b || !graph.is_joint(link.a) || !graph.is_joint(link.b))
    return {};
  const auto &a = graph.at(link.a).node, &b = graph.at(link.b).node;
  const double d = distance(a.position, b.position);
  if (d >= a.radius + b.radius) return {};
  for (const auto& n : link.inner)
    if (!in_ball(n.position, a, voxel) && !in_ball(n.position, b, voxel)) return {};
  return d / (a.radius + b.radius);
}

VoteGraph::Node barycentre(const BranchGraph::Vertex& a, const BranchGraph::Vertex& b) {
  VoteGraph::Node node = a.node;
  node.position = (a.node.position * a.merged + b.node.position * b.merged) / (a.merged + b.merged);
  node.radius = std::min(a.node.radius, b.node.radius);
  node.support = std::min(a.node.support, b.node.support);
  return node;
}

double cycle_length(const BranchGraph& graph, int link) {
  double sum = 0;
  for (const int l : graph.shortest_cycle(link)) sum += graph.length(graph.link(l));
  return sum;
}

/// The least supported link on a cycle that is a weld or closes a short cycle.
std::optional<int> worst_cycle_link(const BranchGraph& graph, double voxel) {
  std::optional<int> worst;
  std::tuple<int, double> least;
  for (const int l : graph.links_on_cycles()) {
    const double length = graph.length(graph.link(l));
    const int support = graph.least_support(graph.link(l));
    const bool weld = length <= kWeldVoxels * voxel && support < kWeldSupport;
    if (!weld && cycle_length(graph, l) >= kShortestCycleVoxels * voxel) continue;
    if (!worst || std::tuple(support, length) < least) worst = l, least = {support, length};
  }
  return worst;
}

}  // namespace

VoteGraph collapse_branches(const VoteGraph& graph, double voxel) {
  BranchGraph g(graph);
  for (;;) {
    int nearest = -1;
    double least = 1;
    for (int l = 0; l < g.link_count(); ++l)
      if (const auto c = closeness(g, g.link(l), voxel); c && *c < least) least = *c, nearest = l;
    if (nearest < 0) return g.result();
    g.contract(nearest, barycentre(g.at(g.link(nearest).a), g.at(g.link(nearest).b)));
  }
}

VoteGraph cut_short_cycles(const VoteGraph& graph, double voxel) {
  BranchGraph g(graph);
  while (const auto worst = worst_cycle_link(g, voxel)) g.cut(*worst);
  return g.result();
}

}  // namespace marrow
