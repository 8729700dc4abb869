#include <marrow/perceptual_core.hpp>

#include "catch.hpp"
#include "graphs.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr double kVoxel = 0.02;

/// A trunk along x from -1 to 1 with a twig along y from its middle.
VoteGraph trunk_with_twig(double twig, const Pen& twig_pen, const Pen& trunk_pen = {}) {
  VoteGraph graph;
  const NodeId left = add_node(graph, {-1, 0, 0}, trunk_pen);
  const NodeId middle = draw(graph, left, {0, 0, 0}, trunk_pen);
  draw(graph, middle, {1, 0, 0}, trunk_pen);
  draw(graph, middle, {0, twig, 0}, twig_pen);
  return graph;
}

bool has_tip(const VoteGraph& graph, const Vec3& p) { return has_node_at(graph, p); }

VoteGraph tidied(VoteGraph graph) {
  std::sort(graph.edges.begin(), graph.edges.end());
  return graph;
}

int leaves_of(const VoteGraph& graph) { return leaf_count(counts_of(graph)); }

/// Length of a twig on a joint of radius 0.05 of which `share` of (r_leaf + 2 voxels) is outside.
double twig_length(double share) { return 0.05 + share * (0.05 + 2 * kVoxel); }

/// Fine steps: which half of a step is in a ball decides nothing.
constexpr Pen kFine{0.001, 0.05, 42};

}  // namespace

TEST_CASE("a twig whose ball touches the joint's goes", "[perceptual_core]") {
  const Pen twig{0.02, 0.04, 42};  // reach: 0.05 of the joint and 0.04
  const VoteGraph without = prune_by_zone_of_influence(trunk_with_twig(0.08, twig), Zone::OfWays);
  CHECK_FALSE(has_tip(without, {0, 0.08, 0}));
  CHECK(leaves_of(without) == 2);
  CHECK(has_tip(without, {-1, 0, 0}));
  CHECK(has_tip(without, {1, 0, 0}));
  const VoteGraph with = prune_by_zone_of_influence(trunk_with_twig(0.1, twig), Zone::OfWays);
  CHECK(has_tip(with, {0, 0.1, 0}));
  CHECK(leaves_of(with) == 3);
}

TEST_CASE("of leaves that all touch their joint the most significant stays", "[perceptual_core]") {
  // A fork at the right end, both tips in the ball of its joint.
  for (const bool upper_is_strong : {false, true}) {
    VoteGraph graph;
    const NodeId left = add_node(graph, {-1, 0, 0}, {});
    const NodeId fork = draw(graph, left, {1, 0, 0}, {});
    draw(graph, fork, {1.02, 0.04, 0}, {0.02, 0.05, upper_is_strong ? 42 : 30});
    draw(graph, fork, {1.02, -0.04, 0}, {0.02, 0.05, upper_is_strong ? 30 : 42});
    const VoteGraph pruned = prune_by_zone_of_influence(graph, Zone::OfWays);
    CHECK(leaves_of(pruned) == 2);
    CHECK(has_tip(pruned, {1.02, 0.04, 0}) == upper_is_strong);
    CHECK(has_tip(pruned, {1.02, -0.04, 0}) == !upper_is_strong);
  }
}

TEST_CASE("a joint further up has its say on leaves that passed one below", "[perceptual_core]") {
  // The twig's tip is far from the fork it hangs on, but in the ball of the big joint.
  VoteGraph graph;
  const NodeId left = add_node(graph, {-1, 0, 0}, {});
  const NodeId big = draw(graph, left, {0.2, 0, 0}, {0.02, 0.5, 42});
  const NodeId right = draw(graph, big, {1, 0, 0}, {});
  for (auto& n : graph.nodes)
    if (n.position.x < 0.2) n.radius = 0.05;
  graph.nodes[big].radius = 0.5;
  const NodeId fork = draw(graph, big, {0.2, 0.2, 0}, {0.02, 0.01, 42});
  draw(graph, fork, {0.3, 0.3, 0}, {0.02, 0.01, 42});
  draw(graph, fork, {0.1, 0.3, 0}, {0.02, 0.01, 42});
  const VoteGraph pruned = prune_by_zone_of_influence(graph, Zone::OfWays);
  CHECK(leaves_of(pruned) == 2);
  CHECK(has_tip(pruned, graph.nodes[left].position));
  CHECK(has_tip(pruned, graph.nodes[right].position));
}

TEST_CASE("a line that turns round at the end of a limb is no twig", "[perceptual_core]") {
  // Out along a limb and back beside it, into the ball of the joint.
  VoteGraph graph = trunk_with_twig(0.4, {});
  const NodeId turn = nearest_node(graph, {0, 0.4, 0});
  draw(graph, draw(graph, turn, {0.03, 0.4, 0}, {}), {0.03, 0.06, 0}, {});
  const VoteGraph kept = prune_by_zone_of_influence(graph, Zone::OfWays);
  CHECK(leaves_of(kept) == 3);
  CHECK(has_node_at(kept, {0, 0.4, 0}));
  CHECK(leaves_of(prune_by_zone_of_influence(graph, Zone::OfLeaves)) == 2);
}

TEST_CASE("every tree of a forest is pruned on its own", "[perceptual_core]") {
  VoteGraph forest = trunk_with_twig(0.06, {});
  const VoteGraph first = prune_by_zone_of_influence(forest, Zone::OfWays);
  const auto base = static_cast<NodeId>(forest.nodes.size());
  const VoteGraph second = trunk_with_twig(0.3, {});
  for (auto n : second.nodes) {
    n.position.z = 0.5;
    forest.nodes.push_back(n);
  }
  for (const auto& [a, b] : second.edges) forest.edges.push_back({a + base, b + base});
  add_node(forest, {0, 0, -0.5}, {});
  const VoteGraph pruned = prune_by_zone_of_influence(forest, Zone::OfWays);
  CHECK(component_count(counts_of(pruned)) == 3);
  CHECK(leaves_of(pruned) == 2 + 3);
  CHECK(pruned.nodes.size() == first.nodes.size() + second.nodes.size() + 1);
  CHECK(prune_by_zone_of_influence({}, Zone::OfWays) == VoteGraph{});
}

TEST_CASE("a twig goes while it shows less than its tip's radius and two voxels",
          "[perceptual_core]") {
  CHECK(leaves_of(prune_leaves(trunk_with_twig(twig_length(0.95), kFine), kVoxel)) == 2);
  CHECK(leaves_of(prune_leaves(trunk_with_twig(twig_length(1.05), kFine), kVoxel)) == 3);
  // A greater tip must show more.
  const Pen thick{0.001, 0.09, 42};
  CHECK(leaves_of(prune_leaves(trunk_with_twig(twig_length(1.05), thick), kVoxel)) == 2);
  // So must the same twig on a coarser grid.
  CHECK(leaves_of(prune_leaves(trunk_with_twig(twig_length(1.05), kFine), 2 * kVoxel)) == 2);
}

TEST_CASE("a twig of weak support must be longer", "[perceptual_core]") {
  const auto survives = [](double share, int support) {
    VoteGraph graph = trunk_with_twig(twig_length(share), kFine);
    for (auto& n : graph.nodes)
      if (n.position.y > 0) n.broad_support = support, n.support = 0;  // only the broad one counts
    return leaves_of(prune_leaves(graph, kVoxel)) == 3;
  };
  CHECK(survives(1.5, 42));
  // (21 / 42)^3 = 1 / 8, and 0.36 * 8 = 2.88
  CHECK_FALSE(survives(2.8, 21));
  CHECK(survives(2.96, 21));
}

TEST_CASE("what lies in any ball of the rest is not shown", "[perceptual_core]") {
  // The twig runs beside a fat branch: nothing of it is outside.
  VoteGraph graph;
  const NodeId left = add_node(graph, {-1, 0, 0}, {});
  const NodeId joint = draw(graph, left, {0, 0, 0}, {});
  draw(graph, joint, {1, 0, 0}, {0.02, 0.3, 42});
  draw(graph, joint, {0.9, 0.2, 0}, {0.02, 0.02, 42});
  CHECK(leaves_of(prune_leaves(graph, kVoxel)) == 2);
}

TEST_CASE("scores are taken anew after each branch that goes", "[perceptual_core]") {
  // A fork with two short tines: once the lesser is gone the other is the end of the trunk.
  VoteGraph graph;
  const NodeId left = add_node(graph, {-1, 0, 0}, {});
  const NodeId middle = draw(graph, left, {0, 0, 0}, {});
  draw(graph, middle, {0, 1, 0}, {});
  const NodeId fork = draw(graph, middle, {1, 0, 0}, {});
  draw(graph, fork, {1.05, 0.06, 0}, {});
  draw(graph, fork, {1.05, -0.04, 0}, {});
  const VoteGraph pruned = prune_leaves(graph, kVoxel);
  CHECK(leaves_of(pruned) == 3);
  CHECK(has_tip(pruned, {1.05, 0.06, 0}));
  CHECK_FALSE(has_tip(pruned, {1.05, -0.04, 0}));
}

TEST_CASE("a part that is a single path stays, and so does a ring", "[perceptual_core]") {
  VoteGraph path;
  draw(path, add_node(path, {0, 0, 0}, {0.01, 0.5, 1}), {0.05, 0, 0}, {0.01, 0.5, 1});
  path = tidied(path);
  CHECK(prune_leaves(path, kVoxel) == path);
  CHECK(extract_perceptual_core(path, kVoxel) == path);

  VoteGraph ring;
  const NodeId a = add_node(ring, {0, 0, 0}, {});
  const NodeId b = draw(ring, a, {1, 0, 0}, {});
  const NodeId c = draw(ring, b, {0, 1, 0}, {});
  join(ring, c, a, {});
  ring = tidied(ring);
  CHECK(prune_leaves(ring, kVoxel) == ring);
  const std::size_t nodes = ring.nodes.size();
  draw(ring, a, {-0.08, -0.02, 0}, {});
  CHECK(prune_leaves(ring, kVoxel).nodes.size() == nodes);
  draw(ring, b, {1.6, 0, 0}, {});
  const VoteGraph pruned = prune_leaves(ring, kVoxel);
  CHECK(leaves_of(pruned) == 1);
  CHECK(cycle_count(counts_of(pruned)) == 1);
}

TEST_CASE("the perceptual core is zones of influence, then the leaf rule", "[perceptual_core]") {
  const VoteGraph tree = trunk_with_twig(0.12, {0.02, 0.04, 42});
  CHECK(leaves_of(prune_by_zone_of_influence(tree, Zone::OfWays)) == 3);
  CHECK(leaves_of(extract_perceptual_core(tree, kVoxel)) == 2);
  CHECK(extract_perceptual_core(tree, kVoxel) ==
        prune_leaves(prune_by_zone_of_influence(tree, Zone::OfWays), kVoxel));
}
