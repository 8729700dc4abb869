// The boundary, the topology and the frame of volumes.
#include <marrow/error.hpp>
#include <marrow/normalization.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/volume_summary.hpp>
#include <marrow/volume_surface.hpp>

#include <functional>
#include <map>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

Volume fill(int nx, int ny, int nz, const std::function<bool(int, int, int)>& is_foreground) {
  Volume v(nx, ny, nz);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        if (is_foreground(x, y, z)) v.set(x, y, z);
  return v;
}

Volume noise(std::uint64_t seed, int nx, int ny, int nz, std::uint32_t of_ten) {
  Random random(seed);
  return fill(nx, ny, nz, [&](int, int, int) { return random.below(10) < of_ten; });
}

bool is_set(const Volume& v, int x, int y, int z) { return v.contains(x, y, z) && v(x, y, z); }

/// Parts of the voxels that are `wanted`, by flooding; neighbours over corners or faces only.
std::size_t count_parts(const Volume& v, bool wanted, bool corners) {
  const int nx = v.nx + 2, ny = v.ny + 2, nz = v.nz + 2;
  std::map<std::array<int, 3>, bool> seen;
  std::size_t parts = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        if (is_set(v, x - 1, y - 1, z - 1) != wanted || seen[{x, y, z}]) continue;
        ++parts;
        std::vector<std::array<int, 3>> stack{{x, y, z}};
        seen[{x, y, z}] = true;
        while (!stack.empty()) {
          const auto [a, b, c] = stack.back();
          stack.pop_back();
          for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
              for (int dx = -1; dx <= 1; ++dx) {
                if (!corners && std::abs(dx) + std::abs(dy) + std::abs(dz) != 1) continue;
                const std::array<int, 3> n{a + dx, b + dy, c + dz};
                if (n[0] < 0 || n[1] < 0 || n[2] < 0 || n[0] >= nx || n[1] >= ny || n[2] >= nz)
                  continue;
                if (is_set(v, n[0] - 1, n[1] - 1, n[2] - 1) != wanted || seen[n]) continue;
                seen[n] = true;
                stack.push_back(n);
              }
        }
      }
  return parts;
}

void check_topology(const Volume& v, std::size_t components, std::size_t cavities,
                    std::size_t tunnels) {
  const auto t = topology_of(v);
  REQUIRE(t);
  CHECK(t->components == components);
  CHECK(t->cavities == cavities);
  CHECK(t->tunnels == tunnels);
}

double signed_volume(const Shape& s) {
  double sum = 0;
  for (const auto& [a, b, c] : s.triangles)
    sum += dot(s.points[a], cross(s.points[b], s.points[c])) / 6;
  return sum;
}

}  // namespace

TEST_CASE("The boundary of a volume is closed, oriented, and where the faces are", "[volume]") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Volume v = noise(seed, seed % 2 == 0 ? 7 : 130, 6, 5, static_cast<std::uint32_t>(1 + seed));
    v.steps = {Vec3{1, 0, 0.5}, Vec3{0, seed < 3 ? 2.0 : -2.0, 0}, Vec3{0, 0, 3}};
    v.origin = {5, 6, 7};
    std::size_t faces = 0;
    for (int z = 0; z < v.nz; ++z)
      for (int y = 0; y < v.ny; ++y)
        for (int x = 0; x < v.nx; ++x) {
          if (!v(x, y, z)) continue;
          for (const int d : {-1, 1}) {
            faces += !is_set(v, x + d, y, z);
            faces += !is_set(v, x, y + d, z);
            faces += !is_set(v, x, y, z + d);
          }
        }
    const Shape surface = boundary_surface(v);
    CHECK(boundary_face_count(v) == faces);
    CHECK(surface.triangles.size() == 2 * faces);
    // No two points at one place, and every point is used.
    const ShapeSummary summary = summarize(surface);
    CHECK(summary.unused_points == 0);
    CHECK(summary.open_edges == 0);
    CHECK(summary.flat_triangles == 0);
    // Outwards, whatever the handedness of the axes: the volume is that of the voxels.
    CHECK(signed_volume(surface) ==
          Approx(6.0 * static_cast<double>(foreground_count(v))).epsilon(1e-9));
    const NormalizedShape n = apply(normalize(v), surface);
    CHECK(n.closed);
    CHECK(n.oriented);
    const Bounds bounds = foreground_bounds(v);
    CHECK(bounds.low == summary.bounds.low);
    CHECK(bounds.high == summary.bounds.high);
  }
}

TEST_CASE("Parts, cavities and tunnels of volumes", "[volume]") {
  const auto box = [](int low, int high) {
    return [=](int x, int y, int z) {
      return std::min({x, y, z}) >= low && std::max({x, y, z}) <= high;
    };
  };
  check_topology(Volume(3, 3, 3), 0, 0, 0);
  check_topology(fill(5, 5, 5, box(0, 4)), 1, 0, 0);
  check_topology(fill(5, 5, 5, [&](int x, int y, int z) { return !box(2, 2)(x, y, z); }), 1, 1, 0);
  check_topology(fill(5, 5, 5, [](int x, int y, int) { return x != 2 || y != 2; }), 1, 0, 1);
  check_topology(fill(9, 5, 2, [](int x, int y, int) { return (x != 2 && x != 6) || y != 2; }), 1,
                 0, 2);
  // Voxels touch over edges and corners, the background does not.
  check_topology(fill(2, 2, 2, [](int x, int y, int z) { return x == y && y == z; }), 1, 0, 0);
  check_topology(fill(3, 3, 1, [](int x, int y, int) { return (x + y) % 2 == 1; }), 1, 0, 1);
  check_topology(fill(130, 1, 1, [](int x, int, int) { return x % 2 == 0; }), 65, 0, 0);
  check_topology(fill(64, 1, 1, [](int, int, int) { return true; }), 1, 0, 0);
}

TEST_CASE("Parts and cavities are those of flooding", "[volume]") {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const int nx = seed % 2 == 0 ? 9 : 67;
    const Volume v = noise(seed, nx, 6, 7, static_cast<std::uint32_t>(1 + seed));
    const auto t = topology_of(v);
    REQUIRE(t);
    INFO("seed " << seed);
    CHECK(t->components == count_parts(v, true, true));
    CHECK(t->cavities == count_parts(v, false, false) - 1);
    CHECK(t->tunnels < 10'000);  // no difference below zero
  }
}

TEST_CASE("A solid volume has the frame of its box", "[volume][normalization]") {
  Volume v(9, 5, 7);
  for (int z = 1; z < 4; ++z)
    for (int y = 2; y < 4; ++y)
      for (int x = 0; x < 9; ++x) v.set(x, y, z);
  v.steps = {Vec3{0, 2, 0}, Vec3{0, 0, 2}, Vec3{2, 0, 0}};  // 18 x 4 x 6 along y, z, x
  v.origin = {100, 200, 300};
  const Normalization n = normalize(v);
  CHECK(n.to_input({0, 0, 0}).x == Approx(100 + 2 * 2));
  CHECK(n.to_input({0, 0, 0}).y == Approx(200 + 2 * 4));
  CHECK(n.to_input({0, 0, 0}).z == Approx(300 + 2 * 2.5));
  CHECK(n.axes.y == Vec3{0, 1, 0});
  CHECK(n.axes.x == Vec3{1, 0, 0});
  CHECK(n.length_to_input(1) == Approx(0.5 * length(Vec3{18, 4, 6})));
}

TEST_CASE("Anisotropic voxels give the frame of the same solid", "[volume][normalization]") {
  // An L of cubes, and the same with voxels three times as long along z.
  const auto is_l = [](int x, int y, int z) { return z < 12 && (y < 8 || (x < 10 && y < 40)); };
  const Volume cubes = fill(30, 40, 12, is_l);
  Volume slabs = fill(30, 40, 4, is_l);
  slabs.steps[2] = {0, 0, 3};
  slabs.origin = {0, 0, 1};  // the middle of three
  const Normalization a = normalize(cubes), b = normalize(slabs);
  CHECK(distance(a.center / a.prescale, b.center / b.prescale) < 1e-9);
  CHECK(distance(a.axes.x, b.axes.x) < 1e-9);
  CHECK(distance(a.axes.y, b.axes.y) < 1e-9);
  CHECK(a.length_to_input(1) == Approx(b.length_to_input(1)));
}

TEST_CASE("The frame of a volume turns with it", "[volume][normalization]") {
  const auto is_foreground = [](int x, int y, int z) {
    return (y < 8 && z < 6) || (x < 10 && z < 9 - y / 8);
  };
  Random random(9);
  Volume v = fill(30, 40, 12, is_foreground);
  const Normalization straight = normalize(v);
  for (int i = 0; i < 5; ++i) {
    const Frame f = random.frame();
    Volume turned = v;
    turned.steps = {f.x, f.y, f.z};
    const Normalization n = normalize(turned);
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{7, 3, 1}, Vec3{20, 30, 5}})
      CHECK(distance(n.to_normalized(turned.to_world(p)), straight.to_normalized(p)) < 1e-6);
  }
}

TEST_CASE("Volumes without foreground have no frame", "[volume][normalization]") {
  CHECK_THROWS_AS(normalize(Volume(3, 3, 3)), Error);
  Volume far(2, 2, 2);
  far.set(0, 0, 0);
  CHECK_NOTHROW(normalize(far));
  far.origin = {1e20, 0, 0};
  CHECK_THROWS_AS(normalize(far), Error);
}
