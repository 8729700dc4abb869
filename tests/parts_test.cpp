#include <marrow/extract.hpp>
#include <marrow/parts.hpp>

#include "analytic/analytic_shapes.hpp"
#include "catch.hpp"

using namespace marrow;

namespace {

/// A path, a ball, a ring and a speck, the nodes of the path and the ring mixed.
CurveSkeleton four_parts() {
  CurveSkeleton s;
  const auto node = [&](double x, double y, double radius) {
    s.nodes.push_back({{x, y, 0}, radius});
  };
  node(0, 0, 0.5);     // 0: path
  node(20, 0, 3);      // 1: ball
  node(1, 0, 0.5);     // 2: path
  node(40, 0, 0.25);   // 3: ring
  node(44, 0, 0.25);   // 4: ring
  node(2, 0, 0.5);     // 5: path
  node(44, 3, 0.25);   // 6: ring
  node(60, 0, 0.125);  // 7: speck
  s.edges = {{0, 2}, {2, 5}, {3, 4}, {3, 6}, {4, 6}};
  return s;
}

CurveSkeleton skeleton_of_made(const std::string& name) {
  ExtractOptions options;
  options.image_resolution = 128;
  options.grid_resolution = 64;
  return extract(make_analytic_shape(name, {0.5}).shape, options);
}

}  // namespace

TEST_CASE("the size of a part runs from surface to surface", "[parts]") {
  CHECK(part_sizes({}).empty());
  CHECK(part_sizes(four_parts()) == std::vector<double>{3, 6, 12, 0.25});
}

TEST_CASE("the largest part, with its nodes and edges in their order", "[parts]") {
  const CurveSkeleton all = four_parts(), ring = largest_part(all);
  CHECK(ring.nodes == std::vector{all.nodes[3], all.nodes[4], all.nodes[6]});
  CHECK(ring.edges == std::vector<CurveSkeleton::Edge>{{0, 1}, {0, 2}, {1, 2}});
  CHECK(largest_part(ring) == ring);
  CHECK(largest_part({}) == CurveSkeleton{});
}

TEST_CASE("of two parts of one size the first is the largest", "[parts]") {
  CurveSkeleton twins;
  for (const double x : {0, 1, 5, 6}) twins.nodes.push_back({{x, 0, 0}, 1});
  twins.edges = {{0, 1}, {2, 3}};
  CHECK(largest_part(twins).nodes.front() == twins.nodes.front());
  CHECK(largest_part(twins).nodes.size() == 2);
  CHECK(large_parts(twins, 1) == twins);
}

TEST_CASE("parts under a share of the greatest go", "[parts]") {
  const CurveSkeleton all = four_parts();
  CHECK(large_parts(all, 0) == all);
  CHECK(part_sizes(large_parts(all, 0.1)) == std::vector<double>{3, 6, 12});
  CHECK(part_sizes(large_parts(all, 0.25)) == std::vector<double>{3, 6, 12});  // exactly
  CHECK(part_sizes(large_parts(all, 0.3)) == std::vector<double>{6, 12});
  CHECK(part_sizes(large_parts(all, 0.6)) == std::vector<double>{12});
  CHECK(large_parts(all, 1) == largest_part(all));
  CHECK(large_parts({}, 0.5) == CurveSkeleton{});
}

TEST_CASE("closed parts that overlap are one body", "[parts]") {
  for (const std::string name : {"y-union", "star-union", "stick-figure-union"}) {
    INFO(name);
    const CurveSkeleton whole = skeleton_of_made(name);
    CHECK(component_count(whole) == 1);
    CHECK(largest_part(whole) == whole);
  }
}

TEST_CASE("closed parts that do not touch are parts of the skeleton", "[parts]") {
  const CurveSkeleton rings = skeleton_of_made("rings");
  REQUIRE(component_count(rings) == 3);
  const CurveSkeleton ring = largest_part(rings);
  CHECK(component_count(ring) == 1);
  CHECK(cycle_count(ring) == 1);
  CHECK(large_parts(rings, 0.5) == rings);
}
