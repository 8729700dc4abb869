// Joints and skin weights: a rig at rest leaves its mesh where it is.
#include <marrow/error.hpp>
#include <marrow/rig.hpp>

#include <analytic_shapes.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "catch.hpp"

using namespace marrow;

namespace {

using Json = nlohmann::json;

/// The JSON of a .glb and the numbers of its arrays.
class Glb {
 public:
  explicit Glb(const std::string& file) {
    const std::uint32_t size = word(file, 12);
    json = Json::parse(file.substr(20, size));
    binary_ = file.substr(28 + size);
    CHECK(word(file, 8) == file.size());
    CHECK(json["buffers"][0]["byteLength"] == binary_.size());
  }
  double number(std::size_t accessor, std::size_t i) const {
    const std::size_t at = begin_of(accessor);
    if (json["accessors"][accessor]["componentType"] == 5123)
      return word(binary_, (at + 2 * i) / 4 * 4) >> (i % 2 == 0 ? 0 : 16) & 0xffff;
    return std::bit_cast<float>(word(binary_, at + 4 * i));
  }
  std::size_t attribute(const char* name) const {
    return json["meshes"][0]["primitives"][0]["attributes"][name];
  }

  Json json;

 private:
  std::size_t begin_of(std::size_t accessor) const {
    return json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()]
               ["byteOffset"];
  }
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
      value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  }

  std::string binary_;
};

/// Where every node of the scene is, by the translations on the way to it; each is met once.
void place(const Json& nodes, std::size_t n, Vec3 at, std::vector<Vec3>& places, int& met) {
  if (nodes[n].contains("translation")) {
    const auto& t = nodes[n]["translation"];
    at = at + Vec3{t[0], t[1], t[2]};
  }
  places[n] = at;
  ++met;
  if (nodes[n].contains("children"))
    for (const auto& child : nodes[n]["children"]) place(nodes, child, at, places, met);
}

}  // namespace

TEST_CASE("a rig at rest leaves its mesh where it is", "[rig]") {
  const std::string name = GENERATE("octopus", "rings", "y");
  CAPTURE(name);
  const AnalyticShape made = make_analytic_shape(name, {0.5});
  const SurfaceMap map = map_surface(made.shape, made.truth);
  const Glb glb(format_rig_glb(made.shape, made.truth, map));
  const std::size_t joints = made.truth.nodes.size();
  const Json& nodes = glb.json["nodes"];
  REQUIRE(nodes.size() == joints + 2);
  REQUIRE(glb.json["skins"][0]["joints"].size() == joints);

  std::vector<Vec3> places(nodes.size());
  int met = 0;
  for (const auto& root : glb.json["scenes"][0]["nodes"]) place(nodes, root, {}, places, met);
  CHECK(met == static_cast<int>(nodes.size()));
  const std::size_t matrices = glb.json["skins"][0]["inverseBindMatrices"];
  double worst = 0;
  for (std::size_t n = 0; n < joints; ++n) {
    const Vec3 back{glb.number(matrices, 16 * n + 12), glb.number(matrices, 16 * n + 13),
                    glb.number(matrices, 16 * n + 14)};
    const Vec3 joint = places[glb.json["skins"][0]["joints"][n].get<std::size_t>()];
    worst = std::max({worst, length(joint + back), distance(joint, made.truth.nodes[n].position)});
  }
  CHECK(worst < 1e-5);

  const std::size_t of_joints = glb.attribute("JOINTS_0"), shares = glb.attribute("WEIGHTS_0");
  bool are_right = true;
  for (std::size_t i = 0; i < made.shape.points.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double share = glb.number(shares, 4 * i + k), joint = glb.number(of_joints, 4 * i + k);
      are_right = are_right && share >= 0 && joint < double(joints) && (share > 0 || joint == 0);
      sum += share;
    }
    are_right = are_right && std::abs(sum - 1) < 1e-7;
  }
  CHECK(are_right);
}

TEST_CASE("skin weights go from node to node along a branch", "[rig]") {
  const CurveSkeleton line{{{{0, 0, 0}, 1}, {{2, 0, 0}, 1}, {{4, 0, 0}, 1}}, {{0, 1}, {1, 2}}};
  const Shape mesh{{{-1, 1, 0}, {0.5, 1, 0}, {1.5, 1, 0}, {2, 1, 0}, {3, 0, 1}},
                   {{0, 1, 2}, {2, 3, 4}}};
  SurfaceMap map;
  map.branches = {{{0, 1, 2}}};
  map.places = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  map.part_count = 1;
  CHECK(skin_weights(mesh, line, map) ==
        std::vector<SkinWeight>{{0, 0, 0}, {0, 1, 0.25}, {1, 0, 0.25}, {1, 1, 0}, {2, 1, 0.5}});
}

TEST_CASE("a rig is of a mesh", "[rig]") {
  const AnalyticShape made = make_analytic_shape("y", {0.5});
  const Shape cloud{made.shape.points, {}};
  CHECK_THROWS_AS(format_rig_glb(cloud, made.truth, map_surface(cloud, made.truth)), Error);
  CurveSkeleton long_line;
  for (NodeId n = 0; n < 65536; ++n) {
    long_line.nodes.push_back({{double(n), 0, 0}, 1});
    if (n > 0) long_line.edges.push_back({n - 1, n});
  }
  CHECK_THROWS_AS(format_rig_glb(made.shape, long_line, SurfaceMap{}), Error);
}
