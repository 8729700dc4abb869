#include <marrow/cycle_check.hpp>

#include "catch.hpp"
#include "graphs.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr double kVoxel = 0.02;
constexpr Pen kLine{0.02, 0.05, 40};
constexpr Pen kWeak{0.02, 0.05, 12};

VoteGraph cut(const VoteGraph& graph, const Shape& shape, double voxel = kVoxel) {
  const NormalizedShape normalized_shape = as_normalized(shape);
  SurfaceSides surface(normalized_shape);
  return cut_false_cycles(graph, surface, voxel);
}

VoteGraph cut_welds(const VoteGraph& graph, const NormalizedShape& shape) {
  SurfaceSides surface(shape);
  return marrow::cut_welds(graph, surface, kVoxel);
}

int cycles_of(const VoteGraph& graph) { return cycle_count(counts_of(graph)); }
int parts_of(const VoteGraph& graph) { return component_count(counts_of(graph)); }

/// Two legs along y at x = -0.5 and 0.5 and a bar on top, bones and flesh.
struct Gate {
  VoteGraph graph;
  Shape shape;
};

constexpr double kHalf = 0.06;  // of the legs' thickness

Gate gate_with_weld(const Pen& weld) {
  Gate g;
  add_box(g.shape, {-0.5 - kHalf, -0.8, -kHalf}, {-0.5 + kHalf, 0.8, kHalf});
  add_box(g.shape, {0.5 - kHalf, -0.8, -kHalf}, {0.5 + kHalf, 0.8, kHalf});
  add_box(g.shape, {-0.55, 0.8 - 2 * kHalf, -0.05}, {0.55, 0.79, 0.05});
  const NodeId left = add_node(g.graph, {-0.5, -0.4, 0}, kLine);
  draw(g.graph, left, {-0.5, -0.75, 0}, kLine);
  const NodeId right = add_node(g.graph, {0.5, -0.4, 0}, kLine);
  draw(g.graph, right, {0.5, -0.75, 0}, kLine);
  const NodeId top_left = draw(g.graph, left, {-0.5, 0.74, 0}, kLine);
  const NodeId top_right = draw(g.graph, top_left, {0.5, 0.74, 0}, kLine);
  join(g.graph, top_right, right, kLine);
  join(g.graph, left, right, weld);
  return g;
}

/// The same with legs so near to each other that the weld gets only five voxels away from them.
Gate narrow(Gate g) {
  const auto squeeze = [](Vec3& p) { p.x += p.x < 0 ? 0.5 - kHalf - 0.08 : -0.5 + kHalf + 0.08; };
  for (auto& p : g.shape.points) squeeze(p);
  for (auto& n : g.graph.nodes) {
    if (std::abs(n.position.x) > 0.49)
      squeeze(n.position);
    else
      n.position.x *= 0.14 / 0.5;
  }
  return g;
}

/// A square ring with an arm at two corners; the side at the bottom is weaker.
VoteGraph square_with_arms(double half) {
  VoteGraph g;
  const NodeId a = add_node(g, {-half, -half, 0}, kLine);
  const NodeId b = add_node(g, {half, -half, 0}, kLine);
  const NodeId c = draw(g, b, {half, half, 0}, kLine);
  const NodeId d = draw(g, c, {-half, half, 0}, kLine);
  join(g, d, a, kLine);
  join(g, a, b, kWeak);
  for (const auto& [corner, x, y] : {std::tuple(a, -0.9, -0.9), {b, 0.9, -0.9}})
    draw(g, corner, {x, y, 0}, kLine);
  return g;
}

Shape square_frame(double half, double thickness) {
  Shape s;
  const double in = half - thickness, out = half + thickness, z = thickness;
  add_box(s, {-out, -out, -z}, {-in, out, z});
  add_box(s, {in, -out, -z * 0.9}, {out, out, z * 0.9});
  add_box(s, {-out, -out * 0.99, -z * 0.8}, {out, -in, z * 0.8});
  add_box(s, {-out, in, -z * 0.7}, {out, out * 0.99, z * 0.7});
  for (const double x : {-1.0, 1.0})
    add_box(s, {std::min(x, x * in), -1, -z * 0.6}, {std::max(x, x * in), -in, z * 0.6});
  return s;
}

}  // namespace

TEST_CASE("a weld between two limbs is cut", "[cycle_check]") {
  const Gate g = narrow(gate_with_weld(kWeak));
  CHECK(cycles_of(g.graph) == 1);
  const VoteGraph result = cut(g.graph, g.shape);
  CHECK(cycles_of(result) == 0);
  CHECK(parts_of(result) == 1);
  CHECK_FALSE(has_node_at(result, {0, -0.4, 0}, 0.05));
  CHECK(has_node_at(result, {0, 0.74, 0}, 0.05));
  CHECK(has_node_at(result, {-0.14, -0.75, 0}, 0.01));
}

TEST_CASE("a well supported weld is cut too", "[cycle_check]") {
  const Gate g = narrow(gate_with_weld(kLine));
  CHECK(cycles_of(cut(g.graph, g.shape)) == 0);
}

TEST_CASE("what the surface covers is no weld", "[cycle_check]") {
  Gate g = narrow(gate_with_weld(kWeak));
  add_box(g.shape, {-0.14, -0.45, -0.05}, {0.14, -0.35, 0.05});
  CHECK(cycles_of(cut(g.graph, g.shape)) == 1);
}

TEST_CASE("a weld that parts two pieces is cut between joints only", "[cycle_check]") {
  // Two bars side by side, joined in their middles.
  VoteGraph graph;
  Shape shape;
  std::array<NodeId, 2> joint{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = i == 0 ? -0.14 : 0.14;
    add_box(shape, {x - kHalf, -0.8, -kHalf}, {x + kHalf, 0.8, kHalf});
    joint[i] = add_node(graph, {x, 0, 0}, kLine);
    draw(graph, joint[i], {x, -0.75, 0}, kLine);
    draw(graph, joint[i], {x, 0.75, 0}, kLine);
  }
  VoteGraph welded = graph;
  join(welded, joint[0], joint[1], kWeak);
  CHECK(parts_of(cut(welded, shape)) == 2);
  VoteGraph limb = graph;  // a limb thinner than the surface shows
  draw(limb, joint[0], {0, 0, 0}, kLine);
  CHECK(parts_of(cut(limb, shape)) == 2);
  CHECK(has_node_at(cut(limb, shape), {0, 0, 0}));
}

TEST_CASE("before joints merge welds on cycles are cut, and nothing else", "[cycle_check]") {
  const Gate g = narrow(gate_with_weld(kWeak));
  const NormalizedShape shape = as_normalized(g.shape);
  const VoteGraph result = cut_welds(g.graph, shape);
  CHECK(cycles_of(result) == 0);
  CHECK_FALSE(has_node_at(result, {0, -0.4, 0}, 0.05));
  // Without the bar the weld is a bridge, which waits.
  VoteGraph bridged = g.graph;
  std::erase_if(bridged.edges, [&](const auto& e) {
    return bridged.nodes[e[0]].position.y > 0.7 && bridged.nodes[e[1]].position.y > 0.7;
  });
  CHECK(cycles_of(bridged) == 0);
  CHECK(cut_welds(bridged, shape) == bridged);
  // A cycle without a hole is no weld.
  const VoteGraph square = square_with_arms(0.3);
  Shape plate;
  add_box(plate, {-1, -1, -0.1}, {1, 1, 0.1});
  CHECK(cut_welds(square, as_normalized(plate)) == square);
}

TEST_CASE("the axis of a cup stays", "[cycle_check]") {
  // Five walls and a graph that runs up the middle of the hollow and forks at the rim.
  Shape cup;
  add_box(cup, {-0.5, -0.8, -0.5}, {0.5, -0.7, 0.5});
  add_box(cup, {-0.5, -0.79, -0.49}, {-0.4, 0.7, 0.49});
  add_box(cup, {0.4, -0.79, -0.49}, {0.5, 0.7, 0.49});
  add_box(cup, {-0.49, -0.78, -0.5}, {0.49, 0.69, -0.4});
  add_box(cup, {-0.49, -0.78, 0.4}, {0.49, 0.69, 0.5});
  VoteGraph graph;
  const NodeId bottom = add_node(graph, {0, -0.75, 0}, kLine);
  const NodeId top = draw(graph, bottom, {0, 0.5, 0}, kLine);
  for (const double x : {-0.45, 0.45}) {
    draw(graph, bottom, {x, -0.75, 0}, kLine);
    draw(graph, top, {x, 0.5, 0}, kLine);
  }
  // Half of the width of the hollow is 20 voxels: that is no gap between limbs.
  CHECK(parts_of(cut(graph, cup)) == 1);
  // On a grid on which it is 4 voxels it is one.
  CHECK(parts_of(cut(graph, cup, 0.1)) == 2);
}

TEST_CASE("a cycle around nothing is cut at its weakest", "[cycle_check]") {
  const Shape plate = make_box({1, 1, 0.1});
  const VoteGraph graph = square_with_arms(0.3);
  REQUIRE(cycles_of(graph) == 1);
  const VoteGraph result = cut(graph, plate);
  CHECK(cycles_of(result) == 0);
  CHECK(parts_of(result) == 1);
  CHECK_FALSE(has_node_at(result, {0, -0.3, 0}, 0.05));
  CHECK(has_node_at(result, {0, 0.3, 0}, 0.05));
}

TEST_CASE("a true ring stays", "[cycle_check]") {
  const VoteGraph graph = square_with_arms(0.5);
  CHECK(cycles_of(cut(graph, square_frame(0.5, 0.1))) == 1);
  CHECK(cut(graph, square_frame(0.5, 0.1)).nodes.size() == graph.nodes.size());
  CHECK(cycles_of(cut(graph, flipped(square_frame(0.5, 0.1)))) == 1);
}

TEST_CASE("where the surface has no say nothing is cut", "[cycle_check]") {
  // A plate that lacks one of each pair of opposite faces: every line runs through a hole.
  Shape open_plate = make_box({1, 1, 0.1});
  const auto all = open_plate.triangles;
  open_plate.triangles = {all[0], all[1], all[4], all[5], all[8], all[9]};
  CHECK(cycles_of(cut(square_with_arms(0.3), open_plate)) == 1);
}

TEST_CASE("surplus cycles are cut, the least supported first", "[cycle_check]") {
  // Three squares in a row share their sides.
  VoteGraph ladder;
  NodeId low = add_node(ladder, {0, 0, 0}, kLine), high = draw(ladder, low, {0, 0.3, 0}, kLine);
  for (int i = 1; i < 4; ++i) {
    const NodeId next = draw(ladder, low, {0.3 * i, 0, 0}, kLine);
    const NodeId above = draw(ladder, high, {0.3 * i, 0.3, 0}, kLine);
    join(ladder, next, above, {0.02, 0.05, 10 * i});
    low = next, high = above;
  }
  for (const double y : {-1.0, 1.0}) draw(ladder, y < 0 ? low : high, {0.9, y, 0}, kLine);
  REQUIRE(cycles_of(ladder) == 3);
  for (int most = 3; most >= 0; --most) {
    const VoteGraph result = cut_surplus_cycles(ladder, most);
    CHECK(cycles_of(result) == most);
    CHECK(parts_of(result) == 1);
    CHECK(has_node_at(result, {0.3, 0.15, 0}, 0.02) == (most == 3));
    CHECK(has_node_at(result, {0.6, 0.15, 0}, 0.02) == (most >= 2));
  }
  CHECK(cycles_of(cut_surplus_cycles(ladder, 7)) == 3);
  CHECK(cut_surplus_cycles({}, 0) == VoteGraph{});
}
