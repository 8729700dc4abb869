#include <marrow/capsule_mesh.hpp>
#include <marrow/error.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/skeleton_io.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

#include "catch.hpp"
#include "mesh_checks.hpp"
#include "random_skeleton.hpp"

using namespace marrow;

namespace {

std::uint32_t word_at(const std::string& bytes, std::size_t place) {
  std::uint32_t word = 0;
  REQUIRE(place + 4 <= bytes.size());
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::uint32_t{static_cast<unsigned char>(bytes[place + i])} << (8 * i);
  return word;
}

/// A GLB taken apart, and its promises checked.
struct Glb {
  nlohmann::json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 4) == "glTF");
    CHECK(word_at(bytes, 4) == 2);
    CHECK(word_at(bytes, 8) == bytes.size());
    const std::size_t size = word_at(bytes, 12);
    CHECK(size % 4 == 0);
    CHECK(bytes.substr(16, 4) == "JSON");
    json = nlohmann::json::parse(bytes.substr(20, size));
    if (20 + size == bytes.size()) return;
    binary = bytes.substr(28 + size);
    CHECK(word_at(bytes, 20 + size) == binary.size());
    CHECK(bytes.substr(24 + size, 4) == std::string("BIN\0", 4));
    CHECK(json["buffers"][0]["byteLength"] == binary.size());
  }
  std::string data(std::size_t accessor) const {
    const auto& view =
        json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    return binary.substr(view["byteOffset"].get<std::size_t>(),
                         view["byteLength"].get<std::size_t>());
  }
  float number(std::size_t accessor, std::size_t i) const {
    float value = 0;
    std::memcpy(&value, data(accessor).data() + 4 * i, 4);
    return value;
  }
};

}  // namespace

TEST_CASE("a ball of a capsule mesh is closed and outward", "[capsule_mesh]") {
  const Shape ball = capsule_mesh({{{{1, 2, 3}, 2}}, {}});
  CHECK(ball.points.size() == 42);
  CHECK(ball.triangles.size() == 80);
  for (const Vec3& p : ball.points) CHECK(distance(p, {1, 2, 3}) == Approx(2));
  CHECK(test::facts_of(ball).is_closed_manifold());
  CHECK(test::volume_of(ball) > 0.85 * 4 / 3 * 3.14159 * 8);
}

TEST_CASE("a capsule mesh is two balls and the cone that touches them", "[capsule_mesh]") {
  const CurveSkeleton s{{{{0, 0, 0}, 1}, {{0, 0, 4}, 2}}, {{0, 1}}};
  const Shape mesh = capsule_mesh(s);
  CHECK(mesh.triangles.size() == 2 * 80 + 60);
  // What lies on the cone is at least a radius away from both ends' centres.
  for (std::size_t i = 84; i < mesh.points.size(); ++i) {
    const Vec3& p = mesh.points[i];
    const double to_first = distance(p, s.nodes[0].position) - 1;
    const double to_second = distance(p, s.nodes[1].position) - 2;
    CHECK(std::min(to_first, to_second) == Approx(0).margin(1e-12));
    CHECK(std::max(to_first, to_second) > 0);
  }
  Shape cone = mesh;
  cone.triangles.assign(mesh.triangles.begin() + 160, mesh.triangles.end());
  CHECK(test::facts_of(cone).boundary_edges == 0);
  CHECK(test::facts_of(cone).bad_edges == 0);
  CHECK(test::volume_of(cone) > 0);
  // A ball within the other needs no cone.
  CHECK(capsule_mesh({{{{0, 0, 0}, 1}, {{0, 0, 1}, 2}}, {{0, 1}}}).triangles.size() == 160);
}

TEST_CASE("a GLB of lines holds places, radii and ends", "[capsule_mesh]") {
  const CurveSkeleton s{{{{0, 0, 0}, 1}, {{1, -2, 3}, 0.5}, {{9, 9, 9}, 2}}, {{0, 1}}};
  const Glb glb(format_skeleton(s, SkeletonFormat::Glb));
  const auto& primitives = glb.json["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 2);
  CHECK(primitives[0]["mode"] == 1);
  CHECK(primitives[1]["mode"] == 0);
  const auto& attributes = primitives[0]["attributes"];
  const std::size_t position = attributes["POSITION"], radius = attributes["_RADIUS"],
                    ends = primitives[0]["indices"];
  CHECK(glb.json["accessors"][position]["min"] == nlohmann::json({0, -2, 0}));
  CHECK(glb.json["accessors"][position]["max"] == nlohmann::json({9, 9, 9}));
  CHECK(glb.number(position, 4) == -2);
  CHECK(glb.number(radius, 1) == 0.5f);
  CHECK(glb.data(ends) == std::string("\0\0\0\0\1\0\0\0", 8));
}

TEST_CASE("every skeleton is a GLB, also of capsules", "[capsule_mesh]") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const CurveSkeleton s = test::random_skeleton(seed, seed % 2 == 1);
    const Glb lines(format_skeleton(s, SkeletonFormat::Glb)), mesh(format_glb(capsule_mesh(s)));
    CHECK(lines.json.contains("meshes") == !s.nodes.empty());
    CHECK(mesh.json.contains("meshes") == !s.nodes.empty());
  }
}

TEST_CASE("what a float cannot hold is not written as GLB", "[capsule_mesh]") {
  const CurveSkeleton far{{{{1e39, 0, 0}, 1}}, {}};
  CHECK_THROWS_AS(format_skeleton(far, SkeletonFormat::Glb), Error);
  CHECK_THROWS_AS(format_glb(capsule_mesh(far)), Error);
}
