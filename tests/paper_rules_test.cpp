// The paper's own rules, read literally: no good skeletons always, but always skeletons.
#include <marrow/branch_collapsing.hpp>
#include <marrow/extract.hpp>
#include <marrow/loop_recovery.hpp>
#include <marrow/perceptual_core.hpp>

#include <analytic_shapes.hpp>

#include <limits>

#include "catch.hpp"
#include "graphs.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "skeleton_faults.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

ExtractOptions by_paper(int image, int grid) {
  ExtractOptions options;
  options.rules = Rules::Paper;
  options.image_resolution = image;
  options.grid_resolution = grid;
  return options;
}

/// Three quarters of a ring whose ends are `gap` apart, with balls of radius 0.1.
VoteGraph open_ring(double gap) {
  VoteGraph graph;
  const Pen pen{0.02, 0.1, 42};
  const NodeId start = add_node(graph, {-0.5 * gap, 0, 0}, pen);
  const NodeId left = draw(graph, start, {-0.6, 0.5, 0}, pen);
  const NodeId right = draw(graph, left, {0.6, 0.5, 0}, pen);
  draw(graph, right, {0.5 * gap, 0, 0}, pen);
  return graph;
}

}  // namespace

TEST_CASE("leaves are joined where their balls meet, and only there", "[paper]") {
  CHECK(cycle_count(counts_of(recover_loops(open_ring(0.19)))) == 1);
  CHECK(cycle_count(counts_of(recover_loops(open_ring(0.21)))) == 0);
}

TEST_CASE("a leaf is joined once, to the leaf whose ball it meets most", "[paper]") {
  VoteGraph graph;
  const Pen pen{0.05, 0.1, 42};
  const NodeId joint = add_node(graph, {0, 1, 0}, pen);
  for (const double x : {-0.15, 0.0, 0.1}) draw(graph, joint, {x, 0, 0}, pen);
  const VoteGraph looped = recover_loops(graph);
  REQUIRE(looped.edges.size() == graph.edges.size() + 1);
  const CurveSkeleton::Edge added{nearest_node(graph, {0, 0, 0}), nearest_node(graph, {0.1, 0, 0})};
  CHECK(std::count(looped.edges.begin(), looped.edges.end(), added) == 1);
  CHECK(std::is_sorted(looped.edges.begin(), looped.edges.end()));
}

TEST_CASE("a part of one edge is no loop", "[paper]") {
  VoteGraph graph;
  const Pen pen{1, 1, 42};
  draw(graph, add_node(graph, {}, pen), {1, 0, 0}, pen);
  CHECK(recover_loops(graph) == graph);
  CHECK(recover_loops({}) == VoteGraph{});
}

TEST_CASE("zones of influence prune until nothing changes", "[paper]") {
  const AnalyticShape made = make_analytic_shape("octopus", {0.5});
  const ExtractTrace trace = extract_with_trace(made.shape, by_paper(128, 64));
  CHECK(prune_by_zone_of_influence(trace.core, Zone::OfLeaves) == trace.core);
  CHECK(trace.core.nodes.size() < trace.tree.nodes.size());
}

TEST_CASE("the stages of the paper are kept, ours are not run", "[paper]") {
  const AnalyticShape made = make_analytic_shape("torus", {0.5});
  const ExtractTrace trace = extract_with_trace(made.shape, by_paper(256, 128));
  CHECK(trace.solid == VoxelSet{});
  CHECK(trace.thinned.nodes.empty());
  CHECK(cycle_count(counts_of(trace.tree)) == 0);
  CHECK(cycle_count(counts_of(trace.collapsed)) == 0);
  CHECK(cycle_count(counts_of(trace.looped)) == 1);
  for (const Vote& v : trace.cleaned.votes) {
    CHECK(v.position == trace.cleaned.grid.center(v.voxel));
    CHECK(v.support == 42);
  }
  for (std::size_t i = 0; i < trace.refined.nodes.size(); ++i)
    CHECK(trace.refined.nodes[i].radius == trace.smoothed.nodes[i].radius);
  for (const auto& n : trace.skeleton.nodes) CHECK(n.section_radius == 0);
}

TEST_CASE("whatever the shape, the paper's rules give a valid graph", "[paper]") {
  Random random(9);
  std::vector<Shape> shapes{make_box({1, 2, 0.5}),        make_box({1, 1, 1e-6}),
                            make_box({1e-6, 1, 1e-6}),    make_soup(random, 40, 60),
                            make_ellipsoid({1, 1, 1}, 2), {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}}};
  for (const char* name : {"y", "rings", "plate", "gingerbread-man", "star-union"})
    shapes.push_back(make_analytic_shape(name, {0.5}).shape);
  shapes.push_back({make_analytic_shape("torus", {0.5}).shape.points, {}});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    INFO("shape " << i);
    ExtractOptions options = by_paper(64, 24);
    const CurveSkeleton skeleton = extract(shapes[i], options);
    CHECK(fault_of(skeleton).empty());
    CHECK_FALSE(skeleton.edges.empty());
    options.max_threads = 1;
    options.refinement = Refinement::None;
    CHECK(extract(shapes[i], options) == skeleton);
  }
}

TEST_CASE("a plain shape comes out right by either rules", "[paper]") {
  const AnalyticShape made = make_analytic_shape("s-tube", {0.5});
  const CurveSkeleton skeleton = extract(made.shape, by_paper(128, 64));
  CHECK(component_count(skeleton) == 1);
  CHECK(cycle_count(skeleton) == 0);
}
