#include <marrow/branch_collapsing.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

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

/// Whether the shortest cycle through a link, which must lie on one, is shorter than `limit`.
bool closes_within(const BranchGraph& graph, int link, double limit) {
  // Sums in another order may round to the other side: a little more is looked at.
  const auto way = graph.shortest_way_around(link, 1.001 * limit);
  if (way.empty() && graph.link(link).a != graph.link(link).b) return false;
  double sum = graph.length(link);
  for (const int l : way) sum += graph.length(l);
  return sum < limit;
}

/// Links that may merge, the closest first. Merging two vertices changes nothing but the links at
/// them.
class Closest {
 public:
  Closest(const BranchGraph& graph, double voxel)
      : graph_(graph), voxel_(voxel), closeness_(static_cast<std::size_t>(graph.link_count())) {
    for (int l = 0; l < graph.link_count(); ++l) update(l);
  }

  std::optional<int> link() const {
    return queue_.empty() ? std::nullopt : std::optional(queue_.begin()->second);
  }

  void update(int link) {
    auto& known = closeness_[static_cast<std::size_t>(link)];
    if (known) queue_.erase({*known, link});
    known = closeness(graph_, graph_.link(link), voxel_);
    if (known && !(*known < 1)) known.reset();
    if (known) queue_.insert({*known, link});
  }

 private:
  const BranchGraph& graph_;
  double voxel_;
  std::vector<std::optional<double>> closeness_;
  std::set<std::pair<double, int>> queue_;
};

/// Whether a link is a weld or closes a short cycle; it must lie on a cycle.
bool is_doubtful(const BranchGraph& graph, int l, double voxel) {
  const double length = graph.length(l), shortest = kShortestCycleVoxels * voxel;
  if (length <= kWeldVoxels * voxel && graph.least_support(l) < kWeldSupport) return true;
  return length < shortest && closes_within(graph, l, shortest);
}

/// Links in the order in which they would be cut: least support, then length, then number.
class CutOrder {
 public:
  CutOrder(const BranchGraph& graph, double voxel)
      : graph_(graph), voxel_(voxel), key_(static_cast<std::size_t>(graph.link_count())) {
    for (int l = 0; l < graph.link_count(); ++l) update(l);
  }

  void update(int link) {
    auto& key = key_[static_cast<std::size_t>(link)];
    if (key) queue_.erase(*key);
    key.reset();
    if (!graph_.link(link).alive) return;
    const double length = graph_.length(link);
    if (length >= kShortestCycleVoxels * voxel_) return;
    key = Key(graph_.least_support(link), length, link);
    queue_.insert(*key);
  }

  /// The first doubtful link on a cycle. Cuts make cycles longer and fewer, so that what is sound
  /// once stays so until the link itself grows.
  std::optional<int> next() {
    if (queue_.empty()) return {};
    std::vector<bool> on_cycle(key_.size(), false);
    for (const int l : graph_.links_on_cycles()) on_cycle[static_cast<std::size_t>(l)] = true;
    while (!queue_.empty()) {
      const int l = std::get<2>(*queue_.begin());
      if (on_cycle[static_cast<std::size_t>(l)] && is_doubtful(graph_, l, voxel_)) return l;
      queue_.erase(queue_.begin());
      key_[static_cast<std::size_t>(l)].reset();
    }
    return {};
  }

 private:
  using Key = std::tuple<int, double, int>;

  const BranchGraph& graph_;
  double voxel_;
  std::vector<std::optional<Key>> key_;
  std::set<Key> queue_;
};

}  // namespace

VoteGraph collapse_branches(const VoteGraph& graph, double voxel) {
  BranchGraph g(graph);
  Closest closest(g, voxel);
  while (const auto link = closest.link()) {
    const auto beside = g.links_beside(*link);
    g.contract(*link, barycentre(g.at(g.link(*link).a), g.at(g.link(*link).b)));
    for (const int l : beside) closest.update(l);
  }
  return g.result();
}

VoteGraph cut_short_cycles(const VoteGraph& graph, double voxel) {
  BranchGraph g(graph);
  CutOrder order(g, voxel);
  while (const auto worst = order.next()) {
    const auto beside = g.links_beside(*worst);
    g.cut(*worst);
    for (const int l : beside) order.update(l);
  }
  return g.result();
}

}  // namespace marrow
