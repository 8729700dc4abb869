#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/surface_map.hpp>
#include <marrow/volume_surface.hpp>

#include <analytic_shapes.hpp>
#include <voxelise.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "catch.hpp"
#include "scale.hpp"

using namespace marrow;

namespace {

using Bones = std::set<std::size_t>;

/// The flesh of a shape by its true bones, which are the branches of its true skeleton.
class Flesh {
 public:
  explicit Flesh(const CurveSkeleton& truth) : truth_(truth), bones_(branches(truth)) {}

  /// From the ball of bone `b` that is nearest to `p`; negative inside.
  double gap(std::size_t b, const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const NodeId n : bones_[b].nodes)
      least = std::min(least, distance(truth_.nodes[n].position, p) - truth_.nodes[n].radius);
    return least;
  }

  /// The bones that a place of the surface may belong to: those nearly as near as the nearest.
  Bones around(const Vec3& p) const { return within(p, -std::numeric_limits<double>::infinity()); }
  /// Whether the place is on a limb, where there is a gap to all other bones.
  bool is_on_limb(const Vec3& p) const {
    const Bones own = around(p);
    if (own.size() != 1) return false;
    const auto& nodes = bones_[*own.begin()].nodes;
    const NodeId nearest = *std::min_element(nodes.begin(), nodes.end(), [&](NodeId a, NodeId b) {
      return distance(truth_.nodes[a].position, p) < distance(truth_.nodes[b].position, p);
    });
    const auto& [position, radius, section] = truth_.nodes[nearest];
    for (std::size_t b = 0; b < bones_.size(); ++b)
      if (own.count(b) == 0 && gap(b, position) <= radius + kBlend) return false;
    return true;
  }

  /// The bones that a place in the middle may belong to: also all those whose flesh it is in.
  Bones holding(const Vec3& p) const { return within(p, 0); }

 private:
  Bones within(const Vec3& p, double reach) const {
    std::vector<double> gaps;
    for (std::size_t b = 0; b < bones_.size(); ++b) gaps.push_back(gap(b, p));
    const double most = std::max(*std::min_element(gaps.begin(), gaps.end()) + kBlend, reach);
    Bones bones;
    for (std::size_t b = 0; b < gaps.size(); ++b)
      if (gaps[b] <= most) bones.insert(b);
    return bones;
  }

  static constexpr double kBlend = 0.1;  // bones run into each other

  const CurveSkeleton& truth_;
  std::vector<Branch> bones_;
};

bool share_one(const Bones& a, const Bones& b) {
  return std::any_of(a.begin(), a.end(), [&](std::size_t bone) { return b.count(bone) > 0; });
}

/// Points that are mapped to a node in the flesh of other bones. Where limbs join, the lines of a
/// skeleton that is not the truth may run otherwise, and only the limbs are asked.
std::size_t mapped_across_gaps(const std::vector<Vec3>& points, const SurfaceMap& map,
                               const CurveSkeleton& skeleton, const CurveSkeleton& truth) {
  const Flesh flesh(truth);
  const bool asks_all = &skeleton == &truth;
  std::vector<Bones> of_node;
  for (const auto& n : skeleton.nodes) of_node.push_back(flesh.holding(n.position));
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    count += !share_one(flesh.around(points[i]), of_node[map.places[i].node]) &&
             (asks_all || flesh.is_on_limb(points[i]));
  return count;
}

/// Patches of one branch along the edges of the triangles, which share their points.
std::size_t patch_count(const Shape& shape, const SurfaceMap& map) {
  std::vector<std::size_t> patch(shape.points.size());
  for (std::size_t i = 0; i < patch.size(); ++i) patch[i] = i;
  for (bool changes = true; changes;) {
    changes = false;
    for (const Triangle& t : shape.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (map.places[a].branch != map.places[b].branch || patch[a] == patch[b]) continue;
        patch[a] = patch[b] = std::min(patch[a], patch[b]);
        changes = true;
      }
  }
  std::set<std::size_t> patches;
  for (const Triangle& t : shape.triangles)
    for (const std::uint32_t i : t) patches.insert(patch[i]);
  return patches.size();
}

std::size_t branch_count(const SurfaceMap& map) {
  std::set<std::uint32_t> used;
  for (const auto& place : map.places) used.insert(place.branch);
  return used.size();
}

void check_is_whole(const SurfaceMap& map, const CurveSkeleton& skeleton, std::size_t places) {
  REQUIRE(map.places.size() == places);
  bool is_on_branch = true;
  for (const auto& [node, branch, part] : map.places) {
    REQUIRE(branch < map.branches.size());
    const auto& nodes = map.branches[branch].nodes;
    is_on_branch = is_on_branch && std::find(nodes.begin(), nodes.end(), node) != nodes.end() &&
                   part < map.part_count;
  }
  CHECK(is_on_branch);
  CHECK(map.part_count == static_cast<std::uint32_t>(component_count(skeleton)));
}

/// Two prongs side by side on a base, so near that the wide one's edge is nearer to the line of the
/// narrow one than to its own.
struct Comb {
  static constexpr int kBase = 20, kWide = 20, kGap = 3, kNarrow = 6, kTall = 80;
  static constexpr double kVoxel = 0.05;

  Volume volume{kWide + kGap + kNarrow, kTall, 4};
  CurveSkeleton skeleton;

  Comb() {
    for (int z = 0; z < volume.nz; ++z)
      for (int y = 0; y < kTall; ++y)
        for (int x = 0; x < volume.nx; ++x)
          if (y < kBase || x < kWide || x >= kWide + kGap) volume.set(x, y, z);
    volume.steps = {Vec3{kVoxel, 0, 0}, Vec3{0, kVoxel, 0}, Vec3{0, 0, kVoxel}};
    const auto at = [](double x, double y) {
      return CurveSkeleton::Node{{x * kVoxel, y * kVoxel, 1.5 * kVoxel}, 2 * kVoxel};
    };
    skeleton.nodes = {at(10, 4), at(12, 10), at(9.5, 22), at(9.5, 78), at(25.5, 22), at(25.5, 78)};
    skeleton.edges = {{0, 1}, {1, 2}, {1, 4}, {2, 3}, {4, 5}};
  }

  /// The last node of the prong that a place is on; nothing on the base and near it.
  static int prong_of(const Vec3& p) {
    if (p.y < (kBase + 10) * kVoxel) return -1;
    return p.x < (kWide + 1) * kVoxel ? 3 : 5;
  }
  /// Places on a prong that are mapped to another branch.
  static std::size_t wrong(const std::vector<Vec3>& points, const SurfaceMap& map) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int tip = prong_of(points[i]);
      const auto& nodes = map.branches[map.places[i].branch].nodes;
      count += tip >= 0 && std::count(nodes.begin(), nodes.end(), static_cast<NodeId>(tip)) == 0;
    }
    return count;
  }
};

std::vector<Vec3> middles(const Volume& volume) {
  std::vector<Vec3> points;
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x)
        if (volume(x, y, z))
          points.push_back(volume.to_world(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
  return points;
}

}  // namespace

TEST_CASE("no vertex is mapped across a gap", "[surface_map][truth]") {
  const std::string name = GENERATE("octopus", "hand", "stick-figure");
  CAPTURE(name);
  const AnalyticShape made = make_analytic_shape(name, {scaled(2, 1) * 0.5});
  SECTION("to the true lines") {
    const SurfaceMap map = map_surface(made.shape, made.truth);
    check_is_whole(map, made.truth, made.shape.points.size());
    CHECK(mapped_across_gaps(made.shape.points, map, made.truth, made.truth) == 0);
    CHECK(branch_count(map) == branches(made.truth).size());
    CHECK(patch_count(made.shape, map) == branch_count(map));
    CHECK(map.seen > made.shape.points.size() * 9 / 10);
  }
  SECTION("to the extracted lines") {
    const CurveSkeleton skeleton = extract(made.shape, defaults_or_small(128, 64));
    const SurfaceMap map = map_surface(made.shape, skeleton);
    check_is_whole(map, skeleton, made.shape.points.size());
    CHECK(mapped_across_gaps(made.shape.points, map, skeleton, made.truth) == 0);
    CHECK(patch_count(made.shape, map) == branch_count(map));
  }
  SECTION("of a cloud") {
    const Shape cloud{made.shape.points, {}};
    const SurfaceMap map = map_surface(cloud, made.truth);
    CHECK(mapped_across_gaps(cloud.points, map, made.truth, made.truth) == 0);
  }
  SECTION("of a volume") {
    const Volume volume = voxelise(made.shape, scaled(64, 48));
    const SurfaceMap map = map_surface(volume, made.truth);
    check_is_whole(map, made.truth, middles(volume).size());
    CHECK(mapped_across_gaps(middles(volume), map, made.truth, made.truth) == 0);
  }
}

TEST_CASE("what is nearer across a gap is not taken", "[surface_map]") {
  const Comb comb;
  const Shape mesh = boundary_surface(comb.volume);
  const Shape cloud{mesh.points, {}};
  CHECK(Comb::wrong(mesh.points, map_surface(mesh, comb.skeleton)) == 0);
  CHECK(Comb::wrong(cloud.points, map_surface(cloud, comb.skeleton)) == 0);
  CHECK(Comb::wrong(middles(comb.volume), map_surface(comb.volume, comb.skeleton)) == 0);
  CHECK(patch_count(mesh, map_surface(mesh, comb.skeleton)) == 3);

  // Without a surface in between, distances alone take the wide prong's edge for the other one's.
  Shape loose{mesh.points, {}};
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) loose.triangles.push_back({i, i, i});
  CHECK(Comb::wrong(loose.points, map_surface(loose, comb.skeleton)) > 100);
}

TEST_CASE("points at one place are one", "[surface_map]") {
  const AnalyticShape made = make_analytic_shape("y", {0.5});
  const SurfaceMap map = map_surface(made.shape, made.truth);
  Shape soup;
  for (const Triangle& t : made.shape.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t i : t) soup.points.push_back(made.shape.points[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const SurfaceMap of_soup = map_surface(soup, made.truth);
  bool are_same_branches = true;
  std::map<std::uint32_t, std::size_t> other;
  for (std::size_t t = 0; t < made.shape.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      other[map.places[made.shape.triangles[t][k]].branch] +=
          of_soup.places[3 * t + k].branch != map.places[made.shape.triangles[t][k]].branch;
  // The order of the points may decide at a border between branches, and nowhere else.
  for (const auto& [branch, count] : other) are_same_branches &= count < soup.points.size() / 50;
  CHECK(are_same_branches);
}

TEST_CASE("a map does not depend on the units", "[surface_map]") {
  const AnalyticShape made = make_analytic_shape("y", {0.5});
  const double scale = GENERATE(0x1p+900, 0x1p-900, 0x1p+10);
  const SurfaceMap map = map_surface(made.shape, made.truth);
  Shape shape = made.shape;
  CurveSkeleton skeleton = made.truth;
  for (Vec3& p : shape.points) p = p * scale;
  for (auto& n : skeleton.nodes) n.position = n.position * scale, n.radius *= scale;
  CHECK(map_surface(shape, skeleton).places == map.places);
}

TEST_CASE("parts and lone nodes have numbers of their own", "[surface_map]") {
  AnalyticShape made = make_analytic_shape("rings", {0.5});
  made.truth.nodes.push_back({{50, 0, 0}, 1});
  made.shape.points.push_back({50.5, 0, 0});  // of no triangle
  const SurfaceMap map = map_surface(made.shape, made.truth);
  check_is_whole(map, made.truth, made.shape.points.size());
  CHECK(map.part_count == 4);
  CHECK(map.branches.size() == 4);
  CHECK(map.places.back() ==
        SurfaceMap::Place{static_cast<NodeId>(made.truth.nodes.size() - 1), 3, 3});
  CHECK(patch_count(made.shape, map) == 3);
}

TEST_CASE("legal inputs of every kind are mapped, others refused", "[surface_map]") {
  const CurveSkeleton dot{{{{0, 0, 0}, 1}}, {}};
  const CurveSkeleton line{{{{0, 0, 0}, 1}, {{0, 0, 0}, 1}}, {{0, 1}}};
  const Shape triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  CHECK(map_surface(triangle, dot).places.size() == 3);
  CHECK(map_surface(triangle, line).places.size() == 3);
  CHECK(map_surface(Shape{{{0, 0, 0}}, {}}, dot).places.size() == 1);
  CHECK(map_surface(Shape{{{0, 0, 0}, {0, 0, 0}}, {{0, 1, 1}}}, dot).places.size() == 2);
  CHECK(map_surface(Shape{}, dot).places.empty());
  CHECK(map_surface(Volume(2, 2, 2), dot).places.empty());
  CHECK_THROWS_AS(map_surface(triangle, CurveSkeleton{}), Error);
  CHECK_THROWS_AS(map_surface(Shape{{{0, 0, 0}}, {{0, 1, 2}}}, dot), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(map_surface(triangle, CurveSkeleton{{{{nan, 0, 0}, 1}}, {}}), Error);
}
