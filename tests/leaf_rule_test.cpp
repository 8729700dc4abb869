#include <marrow/perceptual_core.hpp>

#include <algorithm>
#include <optional>

#include "ball_grid_detail.hpp"
#include "catch.hpp"
#include "graphs.hpp"
#include "live_graph_detail.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr double kVoxel = 0.02;

bool holds(const VoteGraph::Node& ball, const VoteGraph::Node& n) {
  return ball.broad_support >= 0.6 * n.broad_support &&
         squared_length(ball.position - n.position) <= ball.radius * ball.radius;
}

/// The score of a leaf branch, by looking at every node for every other; nothing if it stays.
std::optional<double> plain_score(const LiveGraph& graph, const LeafBranch& branch) {
  const auto covered = [&](NodeId n) {
    for (NodeId m = 0; m < graph.size(); ++m)
      if (graph.alive(m) && holds(graph.node(m), graph.node(n)) &&
          std::find(branch.nodes.begin(), branch.nodes.end(), m) == branch.nodes.end())
        return true;
    return false;
  };
  double outside = 0, support = 0;
  for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
    const NodeId a = branch.nodes[i];
    const NodeId b = i + 1 < branch.nodes.size() ? branch.nodes[i + 1] : branch.joint;
    const double half = 0.5 * graph.length(a, b);
    for (const NodeId n : {a, b}) {
      if (n == branch.joint || covered(n)) continue;
      outside += half;
      support += half * graph.node(n).broad_support;
    }
  }
  const double unit = graph.node(branch.leaf()).radius + 2 * kVoxel;
  const double mean = outside > 0 ? support / outside / kImages : 0;
  const double score = outside / unit * mean * mean * mean;
  return outside < unit || score < 0.36 ? std::optional(score) : std::nullopt;
}

/// The leaf rule as it is written: all leaves are judged anew after each branch that goes.
VoteGraph prune_plainly(const VoteGraph& graph) {
  LiveGraph live(graph);
  for (;;) {
    std::optional<std::pair<double, NodeId>> least;
    for (NodeId n = 0; n < live.size(); ++n) {
      if (!live.alive(n) || live.degree(n) != 1) continue;
      const LeafBranch branch = trace_leaf_branch(live, n);
      if (!branch.ends_at_joint) continue;
      const auto score = plain_score(live, branch);
      if (score && (!least || std::pair(*score, n) < *least)) least = {*score, n};
    }
    if (!least) return live.result();
    for (const NodeId n : trace_leaf_branch(live, least->second).nodes) live.remove_node(n);
  }
}

/// A tree of random twigs, with a few edges that close cycles.
VoteGraph thicket(Random& random, int twigs) {
  VoteGraph graph;
  const auto pen = [&] {
    const double radius = random.below(4) == 0 ? random.between(0.1, 0.4) : 0.03 * random.unit();
    return Pen{0.02, radius, static_cast<int>(random.below(43))};
  };
  add_node(graph, {}, pen());
  for (int i = 0; i < twigs; ++i) {
    const NodeId from = random.below(static_cast<std::uint32_t>(graph.nodes.size()));
    const Vec3 to = graph.nodes[from].position + random.vector() * random.between(0.02, 0.4);
    draw(graph, from, to, pen());
  }
  for (int i = 0; i < twigs / 10; ++i) {
    const auto n = static_cast<std::uint32_t>(graph.nodes.size());
    const NodeId a = random.below(n), b = random.below(n);
    if (a != b) add_edge(graph, a, b);
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  return graph;
}

}  // namespace

TEST_CASE("the leaf rule leaves what judging all leaves every time leaves", "[perceptual_core]") {
  Random random(31);
  for (const int twigs : {3, 10, 30, 60}) {
    for (int i = 0; i < 12; ++i) {
      const VoteGraph graph = thicket(random, twigs);
      const VoteGraph pruned = prune_leaves(graph, kVoxel);
      CHECK(pruned.nodes.size() > 0);
      CHECK((pruned == prune_plainly(graph)));
    }
  }
}

TEST_CASE("a ball grid finds every ball that holds a point, once", "[perceptual_core]") {
  Random random(32);
  VoteGraph graph;
  for (int i = 0; i < 2000; ++i) {
    const double size = random.unit();
    add_node(graph, random.vector(), {0.02, i % 10 == 0 ? 0 : size * size * size, 42});
  }
  const BallGrid grid(graph, kVoxel);
  int missing = 0, twice = 0;
  for (int i = 0; i < 500; ++i) {
    // Also middles and points right on a ball.
    const auto& node = graph.nodes[random.below(2000)];
    const Vec3 p = i % 3 == 0   ? random.vector()
                   : i % 3 == 1 ? node.position
                                : node.position + Vec3{node.radius, 0, 0};
    std::vector<int> found(graph.nodes.size(), 0);
    BallGrid::Search search;
    for (NodeId n = grid.next(p, search); n != BallGrid::kNone; n = grid.next(p, search))
      ++found[n];
    for (NodeId n = 0; n < graph.nodes.size(); ++n) {
      twice += found[n] > 1;
      const auto& ball = graph.nodes[n];
      const bool is_held = squared_length(ball.position - p) <= ball.radius * ball.radius;
      missing += is_held && found[n] == 0;
    }
  }
  CHECK(missing == 0);
  CHECK(twice == 0);
}
