#include <marrow/branch_collapsing.hpp>

#include "catch.hpp"
#include "graphs.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr double kVoxel = 0.02;

/// Two joints `gap` apart on the x axis, two arms at each, and the ids of the joints.
struct TwoJoints {
  VoteGraph graph;
  NodeId left = 0, right = 0;
};

TwoJoints two_joints(double gap, double left_radius, double right_radius) {
  TwoJoints t;
  t.left = add_node(t.graph, {0, 0, 0}, {0.02, left_radius, 40});
  t.right = draw(t.graph, t.left, {gap, 0, 0}, {});
  t.graph.nodes[t.right].radius = right_radius;
  t.graph.nodes[t.right].support = 38;
  for (const double y : {-1.0, 1.0}) {
    draw(t.graph, t.left, {-0.5, y, 0}, {});
    draw(t.graph, t.right, {gap + 0.5, y, 0}, {});
  }
  return t;
}

int joints_of(const VoteGraph& graph) { return joint_count(counts_of(graph)); }
int cycles_of(const VoteGraph& graph) { return cycle_count(counts_of(graph)); }
int parts_of(const VoteGraph& graph) { return component_count(counts_of(graph)); }

/// A square ring of this length about the origin with an arm at two corners; its left side has
/// another support.
VoteGraph ring_with_arms(double length, int left_support = 42) {
  const double half = length / 8;
  VoteGraph g;
  const Pen pen{length / 40, 0.01, 42};
  const NodeId a = add_node(g, {-half, -half, 0}, pen), b = draw(g, a, {half, -half, 0}, pen),
               c = draw(g, b, {half, half, 0}, pen), d = draw(g, c, {-half, half, 0}, pen);
  join(g, d, a, {length / 40, 0.01, left_support});
  draw(g, a, {-1, -1, 0}, pen);
  draw(g, d, {-1, 1, 0}, pen);
  return g;
}

/// A great ring closed by a bridge of this length and support between two joints.
VoteGraph bridged(double bridge, int support, bool on_cycle = true) {
  VoteGraph g;
  const Pen pen;
  const NodeId a = add_node(g, {0, 0, 0}, pen);
  const NodeId b = add_node(g, {bridge, 0, 0}, pen);
  join(g, a, b, {0.01, 0.05, support});
  const NodeId top_left = draw(g, a, {-0.5, 1, 0}, pen);
  if (on_cycle) {
    const NodeId top_right = draw(g, top_left, {0.5, 1, 0}, pen);
    join(g, top_right, b, pen);
  } else {
    draw(g, b, {0.5, 1, 0}, pen);
  }
  draw(g, a, {-0.5, -1, 0}, pen);
  draw(g, b, {0.5, -1, 0}, pen);
  return g;
}

}  // namespace

TEST_CASE("joints whose balls intersect merge in their middle", "[branch_collapsing]") {
  const auto [graph, left, right] = two_joints(0.2, 0.15, 0.1);
  const VoteGraph merged = collapse_branches(graph, kVoxel);
  CHECK(joints_of(merged) == 1);
  CHECK(leaf_count(counts_of(merged)) == 4);
  CHECK(parts_of(merged) == 1);
  REQUIRE(has_node_at(merged, {0.1, 0, 0}));
  const auto& joint = merged.nodes[nearest_node(merged, {0.1, 0, 0})];
  CHECK(joint.radius == 0.1);  // the lesser
  CHECK(degrees(counts_of(merged))[nearest_node(merged, {0.1, 0, 0})] == 4);
  CHECK_FALSE(has_node_at(merged, {0, 0, 0}));
  CHECK_FALSE(has_node_at(merged, {0.06, 0, 0}));
}

TEST_CASE("joints whose balls do not meet stay", "[branch_collapsing]") {
  CHECK(joints_of(collapse_branches(two_joints(0.2, 0.11, 0.11).graph, kVoxel)) == 1);
  CHECK(joints_of(collapse_branches(two_joints(0.2, 0.09, 0.1).graph, kVoxel)) == 2);
}

TEST_CASE("a joint stands for all that it has merged", "[branch_collapsing]") {
  // Three joints in a row; the left two are nearest and merge first.
  TwoJoints t = two_joints(0.1, 0.2, 0.2);
  const NodeId third = draw(t.graph, t.right, {0.22, 0, 0}, {0.02, 0.2, 42});
  draw(t.graph, third, {0.22, 0.5, 0.5}, {});
  draw(t.graph, third, {0.22, 0.5, -0.5}, {});
  const VoteGraph merged = collapse_branches(t.graph, kVoxel);
  CHECK(joints_of(merged) == 1);
  CHECK(has_node_at(merged, {(0 + 0.1 + 0.22) / 3, 0, 0}));
}

TEST_CASE("the balls must cover the branch between them", "[branch_collapsing]") {
  // Near joints, and a bow between them that leaves their balls.
  for (const double bow : {0.1, 0.4}) {
    VoteGraph g;
    const NodeId a = add_node(g, {0, 0, 0}, {0.02, 0.2, 42});
    const NodeId top = draw(g, a, {0.1, bow, 0}, {0.02, 0.01, 42});
    const NodeId b = draw(g, top, {0.2, 0, 0}, {0.02, 0.01, 42});
    g.nodes[b].radius = 0.2;
    for (const double z : {-1.0, 1.0}) {
      draw(g, a, {-0.5, 0, z}, {});
      draw(g, b, {0.7, 0, z}, {});
    }
    CHECK(joints_of(collapse_branches(g, kVoxel)) == (bow < 0.2 ? 1 : 2));
  }
}

TEST_CASE("a handle never contracts", "[branch_collapsing]") {
  TwoJoints t = two_joints(0.2, 0.15, 0.15);
  const NodeId top = draw(t.graph, t.left, {0.1, 0, 0.6}, {0.02, 0.01, 42});
  join(t.graph, top, t.right, {0.02, 0.01, 42});
  CHECK(cycles_of(t.graph) == 1);
  const VoteGraph merged = collapse_branches(t.graph, kVoxel);
  CHECK(joints_of(merged) == 1);
  CHECK(cycles_of(merged) == 1);
  CHECK(has_node_at(merged, {0.1, 0, 0.6}));
}

TEST_CASE("cycles shorter than 12 voxels are cut at their weakest", "[branch_collapsing]") {
  const VoteGraph cut = cut_short_cycles(ring_with_arms(11.5 * kVoxel, 30), kVoxel);
  CHECK(cycles_of(cut) == 0);
  CHECK(parts_of(cut) == 1);
  CHECK_FALSE(has_node_at(cut, {-11.5 * kVoxel / 8, 0, 0}, 0.001));  // the left side
  CHECK(has_node_at(cut, {11.5 * kVoxel / 8, 0, 0}, 0.001));
  CHECK(cycles_of(cut_short_cycles(ring_with_arms(12.5 * kVoxel, 30), kVoxel)) == 1);
}

TEST_CASE("a weld is short and weak and lies on a cycle", "[branch_collapsing]") {
  CHECK(cycles_of(cut_short_cycles(bridged(5.5 * kVoxel, 20), kVoxel)) == 0);
  CHECK(parts_of(cut_short_cycles(bridged(5.5 * kVoxel, 20), kVoxel)) == 1);
  CHECK(cycles_of(cut_short_cycles(bridged(5.5 * kVoxel, 21), kVoxel)) == 1);
  CHECK(cycles_of(cut_short_cycles(bridged(6.5 * kVoxel, 20), kVoxel)) == 1);
  CHECK(parts_of(cut_short_cycles(bridged(5.5 * kVoxel, 5, false), kVoxel)) == 1);
}

TEST_CASE("graphs without joints stay as they are", "[branch_collapsing]") {
  VoteGraph ring;  // short, but a part of its own
  const NodeId a = add_node(ring, {0, 0, 0}, {}), b = draw(ring, a, {0.04, 0, 0}, {}),
               c = draw(ring, b, {0, 0.04, 0}, {});
  join(ring, c, a, {});
  CHECK(cycles_of(cut_short_cycles(ring, kVoxel)) == 1);
  CHECK(cycles_of(collapse_branches(ring, kVoxel)) == 1);
  CHECK(collapse_branches({}, kVoxel) == VoteGraph{});
  CHECK(cut_short_cycles({}, kVoxel) == VoteGraph{});
}
