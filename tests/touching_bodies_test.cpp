// Bodies of a point cloud that the discs of their samples weld.
#include <marrow/extract.hpp>
#include <marrow/nearest_sample.hpp>
#include <marrow/touching_bodies.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr int kNodes = 48;                                  // around a ring
constexpr double kRing = 0.5, kTube = 0.06, kApart = 0.08;  // radii, and off the plane of both
constexpr float kSpacing = 0.03F;

double angle_of(double share) { return 2 * 3.14159265358979 * share; }

Vec3 on_ring(int k, double z) {
  const double angle = angle_of(double(k) / kNodes);
  return {kRing * std::cos(angle), kRing * std::sin(angle), z};
}

/// Two rings, one above the other, as nodes on their centre lines.
VoteGraph two_rings() {
  VoteGraph graph;
  for (const double z : {-kApart, kApart})
    for (int k = 0; k < kNodes; ++k) {
      graph.nodes.push_back({on_ring(k, z), kTube, 40, 40, 0});
      const auto first = static_cast<NodeId>(z < 0 ? 0 : kNodes);
      const auto a = first + static_cast<NodeId>(k),
                 b = first + static_cast<NodeId>((k + 1) % kNodes);
      graph.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  return graph;
}

/// Joins node k of the lower ring to the one above it, by way of three nodes.
void weld(VoteGraph& graph, int k) {
  auto last = static_cast<NodeId>(k);
  for (const double z : {-0.5 * kApart, 0.0, 0.5 * kApart}) {
    graph.nodes.push_back({on_ring(k, z), kTube, 30, 30, 0});
    const auto next = static_cast<NodeId>(graph.nodes.size() - 1);
    graph.edges.push_back({last, next});
    last = next;
  }
  graph.edges.push_back({static_cast<NodeId>(kNodes + k), last});
}

/// Samples of the tubes around both rings, but for those within `open` of the weld at node k.
NormalizedShape sampled_tubes(int k = 0, double open = 0) {
  NormalizedShape cloud;
  for (const double z : {-kApart, kApart})
    for (int i = 0; i < 300; ++i)
      for (int j = 0; j < 40; ++j) {
        const double along = angle_of(i / 300.0), around = angle_of(j / 40.0);
        const double r = kRing + kTube * std::cos(around);
        const Vec3 p{r * std::cos(along), r * std::sin(along), z + kTube * std::sin(around)};
        if (distance(p, on_ring(k, 0)) < open) continue;
        cloud.x.push_back(static_cast<float>(p.x));
        cloud.y.push_back(static_cast<float>(p.y));
        cloud.z.push_back(static_cast<float>(p.z));
        cloud.spacing.push_back(kSpacing);
      }
  return cloud;
}

/// Two rings of tubes that cross twice in most pictures, `gap` apart where they do.
Shape crossing_rings(int count, double gap) {
  constexpr double kThick = 0.12;
  Random random(3);
  Shape cloud;
  for (int i = 0; i < count; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const double along = angle_of(random.unit()), around = angle_of(random.unit());
    const double r = 1 + kThick * std::cos(around);
    cloud.points.push_back({0.5 * side + r * std::cos(along), r * std::sin(along),
                            side * (kThick + 0.5 * gap) + kThick * std::sin(around)});
  }
  return cloud;
}

}  // namespace

TEST_CASE("bodies that pass through the surface to each other twice are parted",
          "[touching_bodies]") {
  VoteGraph graph = two_rings();
  CHECK_FALSE(part_bodies(graph, sampled_tubes()));
  weld(graph, 0);
  CHECK_FALSE(part_bodies(graph, sampled_tubes()));  // may be a neck
  weld(graph, 24);
  const auto parted = part_bodies(graph, sampled_tubes());
  REQUIRE(parted);
  const CurveSkeleton skeleton = skeleton_of(*parted);
  CHECK(component_count(skeleton) == 2);
  CHECK(cycle_count(skeleton) == 2);
  CHECK(leaf_count(skeleton) == 0);
}

TEST_CASE("one body that comes together elsewhere is not parted", "[touching_bodies]") {
  VoteGraph graph = two_rings();
  for (const int k : {0, 12, 24}) weld(graph, k);
  CHECK(part_bodies(graph, sampled_tubes()));
  CHECK_FALSE(part_bodies(graph, sampled_tubes(12, 0.12)));  // the way at 12 is open
}

TEST_CASE("what is thinner than its spacing has no surface to pass through", "[touching_bodies]") {
  VoteGraph graph = two_rings();
  for (const int k : {0, 24}) weld(graph, k);
  NormalizedShape cloud = sampled_tubes();
  cloud.spacing.assign(cloud.x.size(), 0.12F);
  CHECK_FALSE(part_bodies(graph, cloud));
}

TEST_CASE("votes at samples do not count", "[touching_bodies]") {
  const VoxelGrid grid{{-1, -1, -1}, 0.02, 101, 101, 101};
  const auto voxel_at = [&](const Vec3& p) {
    const Vec3 at = (p - grid.origin) / grid.size;
    return grid.index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z));
  };
  VoteGrid votes{grid, {}};
  Vote in_the_middle{}, at_the_surface{};
  in_the_middle.voxel = voxel_at(on_ring(0, -kApart));
  at_the_surface.voxel = voxel_at(on_ring(0, -kApart + kTube));
  votes.votes = {in_the_middle, at_the_surface};
  const VoteGrid left = votes_off_samples(votes, sampled_tubes());
  REQUIRE(left.votes.size() == 1);
  CHECK(left.votes[0].voxel == in_the_middle.voxel);
}

TEST_CASE("depths are in the spacing of the nearest sample", "[touching_bodies]") {
  NormalizedShape cloud;
  cloud.x = {0, 0.5F, 0.5F}, cloud.y = {0, 0, 0}, cloud.z = {0, 0, 0};
  cloud.spacing = {0.25F, 0.125F, 0};  // the last one repeats the one before
  const std::vector<Vec3> places{{0.125, 0, 0}, {0.75, 0, 0}};
  CHECK(sample_depths(cloud, places) == std::vector<double>{0.5, 2});
}

TEST_CASE("lone nodes go where there are edges", "[touching_bodies]") {
  VoteGraph graph;
  for (int k = 0; k < 4; ++k) graph.nodes.push_back({on_ring(k, 0), 0.1 * k, 40, 40, 0});
  CHECK(without_lone_nodes(graph) == graph);
  graph.edges = {{1, 3}};
  const VoteGraph left = without_lone_nodes(graph);
  REQUIRE(left.nodes.size() == 2);
  CHECK(left.nodes[0] == graph.nodes[1]);
  CHECK(left.nodes[1] == graph.nodes[3]);
  CHECK(left.edges == std::vector<CurveSkeleton::Edge>{{0, 1}});
}

TEST_CASE("rings closer than their samples stay apart", "[touching_bodies]") {
  for (const double gap : {0.06, 0.08}) {
    // At the full size everywhere: coarser pixels do not tell the rings apart.
    const CurveSkeleton skeleton = extract(crossing_rings(8000, gap));
    INFO(gap);
    CHECK(component_count(skeleton) == 2);
    CHECK(cycle_count(skeleton) == 2);
    CHECK(leaf_count(skeleton) == 0);
  }
}
