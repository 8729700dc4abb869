#include <marrow/error.hpp>
#include <marrow/shape_io.hpp>

#include <analytic_shapes.hpp>

#include <bit>
#include <map>
#include <set>

#include "catch.hpp"
#include "mesh_checks.hpp"
#include "scale.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Made once for all tests.
const AnalyticShape& made_once(const std::string& name, double resolution) {
  static std::map<std::pair<std::string, double>, AnalyticShape> all;
  const auto [found, is_new] = all.try_emplace({name, resolution});
  if (is_new) found->second = make_analytic_shape(name, {resolution});
  return found->second;
}

const AnalyticShape& coarse(const std::string& name) { return made_once(name, kLeastResolution); }

void check_topology(const AnalyticShape& made) {
  const MeshFacts facts = facts_of(made.shape);
  INFO(made.name);
  CHECK(facts.bad_edges == 0);
  CHECK(facts.bad_points == 0);
  CHECK(facts.flat_triangles == 0);
  switch (made.surface) {
    case SurfaceKind::Closed:
      CHECK(facts.is_closed_manifold());
      CHECK(facts.components == made.components);
      CHECK(facts.euler == 2 * made.components - 2 * made.cycles);
      CHECK(volume_of(made.shape) > 0);
      break;
    case SurfaceKind::Overlapping:  // balls
      CHECK(facts.is_closed_manifold());
      CHECK(facts.components > made.components);
      CHECK(facts.euler == 2 * facts.components);
      CHECK(volume_of(made.shape) > 0);
      break;
    case SurfaceKind::Flat:  // a disc
      CHECK(facts.components == 1);
      CHECK(facts.euler == 1);
      CHECK(facts.boundary_edges > 0);
      break;
  }
}

/// Distance from the surface, of a sheet from its rim; negative outside.
double depth_of(const AnalyticShape& made, const Vec3& p) {
  if (made.surface != SurfaceKind::Flat) {
    const double d = distance_to_surface(made.shape, p);
    return winding_number(made.shape, p) > 0 ? d : -d;
  }
  double nearest = std::numeric_limits<double>::max();
  bool is_inside = false;
  for (const auto& [a, b] : boundary_of(made.shape)) {
    nearest = std::min(nearest, distance_to_segment(p, a, b));
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) is_inside = !is_inside;
  }
  return is_inside ? nearest : -nearest;
}

/// True inside a joint's ball, made wider by what the blends around it reach.
bool is_near_joint(const CurveSkeleton& truth, const std::vector<int>& degree, const Vec3& p) {
  for (std::size_t i = 0; i < degree.size(); ++i) {
    const CurveSkeleton::Node& node = truth.nodes[i];
    if (degree[i] >= 3 && distance(node.position, p) < 2.2 * node.radius + 0.05) return true;
  }
  return false;
}

std::uint64_t hash_of(const AnalyticShape& made) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, by words
  const auto add = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3; };
  const auto add_place = [&](const Vec3& p) {
    for (const double x : {p.x, p.y, p.z}) add(std::bit_cast<std::uint64_t>(x));
  };
  for (const Vec3& p : made.shape.points) add_place(p);
  for (const Triangle& t : made.shape.triangles) {
    for (const std::uint32_t i : t) add(i);
  }
  for (const auto& node : made.truth.nodes) {
    add_place(node.position);
    add(std::bit_cast<std::uint64_t>(node.radius));
  }
  for (const auto& edge : made.truth.edges) add(edge[0] * 0x100000000u + edge[1]);
  return hash;
}

}  // namespace

TEST_CASE("analytic shapes: bad requests name the mend") {
  for (const char* name : {"", "horse", "Capsule"}) {
    try {
      make_analytic_shape(name);
      FAIL("made " << name);
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::Usage);
      for (const AnalyticShapeInfo& info : analytic_shapes()) {
        CHECK(std::string(error.what()).find(info.name) != std::string::npos);
      }
    }
  }
  for (const double resolution : {0.0, -1.0, 1e9, std::nan("")}) {
    CHECK_THROWS_AS(make_analytic_shape("capsule", {resolution}), Error);
  }
}

TEST_CASE("analytic shapes: the list has every name once") {
  std::set<std::string> names;
  for (const AnalyticShapeInfo& info : analytic_shapes()) {
    CHECK(names.insert(info.name).second);
    CHECK(std::string(info.note).find('\n') == std::string::npos);
  }
  CHECK(names.size() >= 25);
}

TEST_CASE("analytic shapes: meshes have the topology that they state") {
  for (const AnalyticShapeInfo& info : analytic_shapes()) check_topology(coarse(info.name));
}

TEST_CASE("analytic shapes: finer meshes have the same topology") {
  for (const char* name : {"beads", "trefoil", "mug", "plant", "hand", "gingerbread-man"}) {
    const AnalyticShape fine = make_analytic_shape(name, {1.7});
    check_topology(fine);
    const double ratio = static_cast<double>(fine.shape.triangles.size()) /
                         static_cast<double>(coarse(name).shape.triangles.size());
    CHECK(ratio == Approx(1.7 / kLeastResolution).epsilon(0.2));
    CHECK(fine.truth == coarse(name).truth);
  }
}

TEST_CASE("analytic shapes: bodies bend and stay what they are") {
  for (const char* name : {"stick-figure", "stick-figure-union", "quadruped"}) {
    const AnalyticShape& at_rest = coarse(name);
    for (const int pose : {1, 2, 77}) {
      const AnalyticShape bent = make_analytic_shape(name, {kLeastResolution, pose});
      INFO(name << " in pose " << pose);
      check_topology(bent);
      CHECK(leaf_count(bent.truth) == *at_rest.leaves);
      CHECK(cycle_count(bent.truth) == 0);
      CHECK(bent.truth != at_rest.truth);
      CHECK(total_length(bent.truth) == Approx(total_length(at_rest.truth)).epsilon(0.03));
      CHECK(bent.truth == make_analytic_shape(name, {kLeastResolution, pose}).truth);
    }
  }
  for (const char* name : {"torus", "mug", "gingerbread-man"})
    CHECK_THROWS_AS(make_analytic_shape(name, {1, 1}), Error);
  for (const int pose : {-1, kMostPose + 1})
    CHECK_THROWS_AS(make_analytic_shape("y", {1, pose}), Error);
}

TEST_CASE("analytic shapes: the truth is the graph that they state") {
  for (const AnalyticShapeInfo& info : analytic_shapes()) {
    const AnalyticShape& made = coarse(info.name);
    INFO(made.name);
    CHECK(component_count(made.truth) == made.components);
    CHECK(cycle_count(made.truth) == made.cycles);
    if (made.leaves) CHECK(leaf_count(made.truth) == *made.leaves);
    CHECK(std::is_sorted(made.truth.edges.begin(), made.truth.edges.end()));
    CHECK(std::adjacent_find(made.truth.edges.begin(), made.truth.edges.end()) ==
          made.truth.edges.end());
    for (const auto& [a, b] : made.truth.edges) CHECK(a < b);
  }
}

TEST_CASE("analytic shapes: the truth lies inside, its radii reach the surface") {
  for (const AnalyticShapeInfo& info : analytic_shapes()) {
    const AnalyticShape& made = made_once(info.name, 1);
    const std::vector<int> degree = degrees(made.truth);
    const std::size_t nodes = static_cast<std::size_t>(scaled(80, 20));
    const std::size_t step = std::max<std::size_t>(1, made.truth.nodes.size() / nodes);
    int far = 0, agree = 0;
    for (std::size_t i = 0; i < made.truth.nodes.size(); i += step) {
      const Vec3 place = made.truth.nodes[i].position;
      const double radius = made.truth.nodes[i].radius;
      const double depth = depth_of(made, place);
      INFO(made.name << ": node " << i << " at " << place.x << " " << place.y << " " << place.z
                     << ", radius " << radius << ", depth " << depth);
      CHECK(radius > 0);
      // Walls of overlapping parts pass through joints.
      if (made.surface != SurfaceKind::Overlapping) CHECK(depth > 0.92 * radius);
      if (is_near_joint(made.truth, degree, place)) continue;
      ++far;
      agree += depth < 1.05 * radius;
    }
    INFO(made.name << ": " << agree << " of " << far);
    CHECK(far > 0);
    CHECK(agree >= 0.9 * far);
  }
}

TEST_CASE("analytic shapes: the animal of the demo has at least 50,000 faces") {
  const AnalyticShape animal = make_analytic_shape("quadruped");
  CHECK(animal.shape.triangles.size() >= 50'000);
  check_topology(animal);
}

TEST_CASE("analytic shapes: coordinates are multiples of a millionth") {
  for (const char* name : {"helix", "star", "gingerbread-man"}) {
    for (const Vec3& p : coarse(name).shape.points) {
      for (const double x : {p.x, p.y, p.z}) {
        CHECK(std::round(x * 1e6) / 1e6 == x);
        CHECK_FALSE((x == 0 && std::signbit(x)));
      }
    }
  }
}

TEST_CASE("analytic shapes: the bytes are the same in every build and on every machine") {
  // A changed shape changes its hash; nothing else may.
  const std::map<std::string, std::uint64_t> expected{{"snake", 0xbb79de969e99cecc},
                                                      {"trefoil", 0xef8ec673732317f6},
                                                      {"mug", 0xc02feaf4d5c2d522},
                                                      {"vessel-tree", 0x11bc47f0f5ff5dee},
                                                      {"gingerbread-man", 0xe693a01f08db2912},
                                                      {"octopus", 0x6d9dfa4f7b70a2da},
                                                      {"quadruped", 0x9dcc177ce0b88ffe}};
  for (const auto& [name, hash] : expected) {
    INFO(name);
    CHECK(hash_of(coarse(name)) == hash);
  }
}

TEST_CASE("analytic shapes: the truth as JSON holds whole branches") {
  const std::string y = format_truth_json(coarse("y"));
  const auto count = [](const std::string& text, const std::string& word) {
    int hits = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++hits;
    return hits;
  };
  CHECK(count(y, "\"polyline_xyzr\"") == 3);
  CHECK(count(y, "\"expected\": {\"components\": 1, \"cycles\": 0, \"tips\": [3, 3]}") == 1);
  CHECK(count(y, "\"kind\": \"closed\"") == 1);
  const std::string rings = format_truth_json(coarse("rings"));
  CHECK(count(rings, "\"polyline_xyzr\"") == 3);
  for (const char* loop : {"\"a\": 0, \"b\": 0", "\"a\": 1, \"b\": 1", "\"a\": 2, \"b\": 2"}) {
    CHECK(count(rings, loop) == 1);
  }
  CHECK(count(format_truth_json(coarse("mug")), "\"tips\": \"n/a\"") == 1);
  CHECK(count(format_truth_json(coarse("star-union")), "\"kind\": \"union\"") == 1);
}
