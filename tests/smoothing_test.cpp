#include <marrow/smoothing.hpp>

#include "catch.hpp"
#include "graphs.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr double kVoxel = 0.02;
constexpr Pen kPen{0.01, 0.05, 42};

/// Two arms along x and one of length 1 along y, the support of whose last `weak` length is 20.
VoteGraph arms(double weak, double length_of_arm = 1) {
  VoteGraph graph;
  const NodeId left = add_node(graph, {-1, 0, 0}, kPen);
  const NodeId joint = draw(graph, left, {0, 0, 0}, kPen);
  draw(graph, joint, {1, 0, 0}, kPen);
  draw(graph, joint, {0, length_of_arm, 0}, kPen);
  for (auto& n : graph.nodes)
    if (n.position.y > length_of_arm - weak + 1e-9) n.support = 20;
  return graph;
}

double highest(const VoteGraph& graph) {
  double y = -1;
  for (const auto& n : graph.nodes) y = std::max(y, n.position.y);
  return y;
}

}  // namespace

TEST_CASE("a weak tip goes down to the first node with support", "[smoothing]") {
  CHECK(highest(trim_leaves(arms(0), kVoxel)) == Approx(1));
  CHECK(highest(trim_leaves(arms(0.05), kVoxel)) == Approx(0.95));
  const VoteGraph trimmed = trim_leaves(arms(0.05), kVoxel);
  CHECK(trimmed.nodes.size() == arms(0.05).nodes.size() - 5);
  CHECK(leaf_count(counts_of(trimmed)) == 3);
}

TEST_CASE("no more than the tip's radius and two voxels go", "[smoothing]") {
  CHECK(highest(trim_leaves(arms(0.5), kVoxel)) == Approx(1 - 0.09).margin(0.0101));
  CHECK(highest(trim_leaves(arms(0.5), 2 * kVoxel)) == Approx(1 - 0.13).margin(0.0101));
}

TEST_CASE("a tip that has just enough support stays", "[smoothing]") {
  VoteGraph graph = arms(0.05);
  for (auto& n : graph.nodes) n.support += n.support == 20;
  CHECK(highest(trim_leaves(graph, kVoxel)) == Approx(1));
}

TEST_CASE("a branch never goes as a whole", "[smoothing]") {
  const VoteGraph trimmed = trim_leaves(arms(0.04, 0.04), kVoxel);
  CHECK(highest(trimmed) == Approx(0.01));
  CHECK(leaf_count(counts_of(trimmed)) == 3);
  CHECK(joint_count(counts_of(trimmed)) == 1);
}

/// Two arms along x and a limb along y that ends at y = 1, and comes back by `back` at x = `apart`.
VoteGraph hooked(double back, double apart) {
  const Pen pen{0.01, 0.1, 42};
  VoteGraph graph;
  const NodeId left = add_node(graph, {-1, 0, 0}, pen);
  const NodeId joint = draw(graph, left, {0, 0, 0}, pen);
  draw(graph, joint, {1, 0, 0}, pen);
  const NodeId end = draw(graph, joint, {0, 1, 0}, pen);
  const NodeId turn = draw(graph, end, {apart, 1, 0}, pen);
  draw(graph, turn, {apart, 1 - back, 0}, pen);
  return graph;
}

TEST_CASE("a limb's line that comes back ends at the turn", "[smoothing]") {
  const VoteGraph cut = cut_hooks(hooked(0.4, 0.1), kVoxel);
  CHECK(highest(cut) == Approx(1));
  CHECK(leaf_count(counts_of(cut)) == 3);
  CHECK(component_count(counts_of(cut)) == 1);
  double lowest_of_hook = 1;
  for (const auto& n : cut.nodes)
    if (n.position.x > 0.05 && n.position.y > 0.1)
      lowest_of_hook = std::min(lowest_of_hook, n.position.y);
  CHECK(lowest_of_hook > 0.95);
}

TEST_CASE("lines of two limbs side by side are no hook", "[smoothing]") {
  const auto is_whole = [](const VoteGraph& graph) {
    return cut_hooks(graph, kVoxel).nodes == graph.nodes;
  };
  CHECK(is_whole(hooked(0.4, 0.2)));    // their balls touch
  CHECK(is_whole(hooked(0.02, 0.1)));   // an end that bends
  CHECK(is_whole(hooked(0.09, 0.08)));  // and turns within its ball
  CHECK(is_whole(arms(0)));
  CHECK_FALSE(is_whole(hooked(0.4, 0.1)));
}

TEST_CASE("a weak path keeps its middle", "[smoothing]") {
  VoteGraph path;
  draw(path, add_node(path, {-0.05, 0, 0}, {0.01, 0.5, 1}), {0.05, 0, 0}, {0.01, 0.5, 1});
  const VoteGraph trimmed = trim_leaves(path, kVoxel);
  CHECK(component_count(counts_of(trimmed)) == 1);
  CHECK(has_node_at(trimmed, {0, 0, 0}, 0.006));
  CHECK(trimmed.nodes.size() < path.nodes.size());

  VoteGraph point;
  add_node(point, {0, 0, 0}, {0.01, 0.5, 1});
  CHECK(trim_leaves(point, kVoxel) == point);
  CHECK(trim_leaves({}, kVoxel) == VoteGraph{});
}

TEST_CASE("nodes of a branch move halfway to the middle of their neighbours", "[smoothing]") {
  VoteGraph path;
  for (int i = 0; i < 5; ++i) add_node(path, {double(i), i == 2 ? 1.0 : 0.0, 0}, kPen);
  for (NodeId i = 0; i < 4; ++i) add_edge(path, i, i + 1);
  const VoteGraph once = smooth_branches(path, 1);
  CHECK(once.nodes[0].position == Vec3{0, 0, 0});
  CHECK(once.nodes[1].position == Vec3{1, 0.25, 0});
  CHECK(once.nodes[2].position == Vec3{2, 0.5, 0});
  CHECK(once.nodes[3].position == Vec3{3, 0.25, 0});
  CHECK(once.nodes[4].position == Vec3{4, 0, 0});
  CHECK(once.edges == path.edges);
  CHECK(smooth_branches(path, 3) == smooth_branches(smooth_branches(once, 1), 1));
  CHECK(smooth_branches(path, 0) == path);
}

TEST_CASE("joints, leaves and straight lines stay", "[smoothing]") {
  const VoteGraph graph = arms(0);
  const VoteGraph smooth = smooth_branches(graph, 10);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    CHECK(distance(smooth.nodes[i].position, graph.nodes[i].position) < 1e-12);
    CHECK(smooth.nodes[i].radius == graph.nodes[i].radius);
    CHECK(smooth.nodes[i].support == graph.nodes[i].support);
  }
}

TEST_CASE("a ring without a joint is smoothed all around", "[smoothing]") {
  VoteGraph ring;
  for (const auto& [x, y] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}})
    add_node(ring, {double(x), double(y), 0}, kPen);
  for (NodeId i = 0; i < 4; ++i) add_edge(ring, i, (i + 1) % 4);
  for (const auto& n : smooth_branches(ring, 1).nodes) CHECK(length(n.position) == Approx(0.5));
}
