// extract() on volumes.
#include <marrow/extract.hpp>
#include <marrow/volume_summary.hpp>
#include <marrow/volume_surface.hpp>

#include <analytic_shapes.hpp>
#include <voxelise.hpp>

#include <cmath>

#include "catch.hpp"
#include "random.hpp"
#include "scale.hpp"
#include "skeleton_distances.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// One of each kind; the sanitized build has few.
std::vector<std::string> names() {
#ifdef MARROW_SANITIZE
  return {"torus", "y"};
#else
  return {"beads",        "helix",      "torus",       "trefoil",      "rings",     "y-union",
          "double-torus", "cube-frame", "vessel-tree", "stick-figure", "quadruped", "octopus"};
#endif
}

/// The mean distance between two skeletons in % of `diagonal`, the greater of both ways.
double apart(const CurveSkeleton& a, const CurveSkeleton& b, double diagonal) {
  return 100 * std::max(distances(a, b).mean, distances(b, a).mean) / diagonal;
}

double diagonal_of(const Volume& v) { return foreground_bounds(v).diagonal(); }

/// Every third layer along z, three times as thick.
Volume thinned(const Volume& v) {
  Volume slabs(v.nx, v.ny, v.nz / 3);
  for (int z = 0; z < slabs.nz; ++z)
    for (int y = 0; y < v.ny; ++y)
      for (int x = 0; x < v.nx; ++x)
        if (v(x, y, 3 * z + 1)) slabs.set(x, y, z);
  slabs.steps = {v.steps[0], v.steps[1], v.steps[2] * 3};
  slabs.origin = v.to_world({0, 0, 1});
  return slabs;
}

/// Voxel (x, y, z) becomes (y, -z, x), which is no rotation: the world stays as it is.
Volume stored_differently(const Volume& v) {
  Volume other(v.ny, v.nz, v.nx);
  for (int z = 0; z < v.nz; ++z)
    for (int y = 0; y < v.ny; ++y)
      for (int x = 0; x < v.nx; ++x)
        if (v(x, y, z)) other.set(y, v.nz - 1 - z, x);
  other.steps = {v.steps[1], -v.steps[2], v.steps[0]};
  other.origin = v.to_world({0, 0, double(v.nz - 1)});
  return other;
}

}  // namespace

TEST_CASE("skeletons of volumes are those of the shapes they were made from",
          "[extract][volume][truth]") {
  for (const auto& name : names()) {
    const AnalyticShape made = make_analytic_shape(name);
    for (const int voxels : {128, 256}) {
      if (voxels > scaled(256, 128)) continue;
      const Volume volume = voxelise(made.shape, voxels);
      const CurveSkeleton s = extract(volume, defaults_or_small(96, 48));
      INFO(name << " of " << voxels << ": " << component_count(s) << " parts, " << cycle_count(s)
                << " cycles, " << leaf_count(s) << " leaves");
      CHECK(component_count(s) == made.components);
      CHECK(cycle_count(s) == made.cycles);
      if (made.leaves) CHECK(leaf_count(s) == *made.leaves);
      const double diagonal = diagonal_of(volume);
      CHECK(apart(s, made.truth, diagonal) < scaled(10, 20) * 0.1);
      if (voxels == 128)
        CHECK(apart(s, extract(made.shape, defaults_or_small(96, 48)), diagonal) <
              scaled(10, 20) * 0.1);
    }
  }
}

TEST_CASE("what is stored differently has the same skeleton", "[extract][volume]") {
  const AnalyticShape made = make_analytic_shape("y");
  const Volume volume = voxelise(made.shape, 90);
  const CurveSkeleton s = extract(volume, defaults_or_small(96, 48));
  const double diagonal = diagonal_of(volume);

  const CurveSkeleton other = extract(stored_differently(volume), defaults_or_small(96, 48));
  CHECK(apart(s, other, diagonal) < 0.05);
  CHECK(leaf_count(other) == leaf_count(s));

  const CurveSkeleton slabs = extract(thinned(volume), defaults_or_small(96, 48));
  CHECK(apart(s, slabs, diagonal) < 1);
  CHECK(leaf_count(slabs) == leaf_count(s));
}

TEST_CASE("the skeleton of a turned volume is turned", "[extract][volume]") {
  Volume volume = voxelise(make_analytic_shape("y").shape, 90);
  const CurveSkeleton s = extract(volume, defaults_or_small(96, 48));
  const double diagonal = diagonal_of(volume);
  Random random(4);
  for (int i = 0; i < scaled(4, 1); ++i) {
    const Frame f = random.frame();
    const Vec3 shift = random.vector() * 10;
    Volume turned = volume;
    for (Vec3& step : turned.steps) step = from_frame(f, step);
    turned.origin = from_frame(f, volume.origin) + shift;
    CurveSkeleton back = extract(turned, defaults_or_small(96, 48));
    for (auto& n : back.nodes) n.position = to_frame(f, n.position - shift);
    CHECK(apart(s, back, diagonal) < 0.05);
    CHECK(back.nodes.size() == s.nodes.size());
  }
}

TEST_CASE("a volume is closed at the border of its box", "[extract][volume]") {
  // A rod from one face of the box to the other.
  Volume volume(12, 12, 100);
  for (int z = 0; z < 100; ++z)
    for (int y = 2; y < 10; ++y)
      for (int x = 2; x < 10; ++x) volume.set(x, y, z);
  const CurveSkeleton s = extract(volume, defaults_or_small(96, 48));
  CHECK(leaf_count(s) == 2);
  CHECK(cycle_count(s) == 0);
  CHECK(distance_to(s, {5.5, 5.5, 50}, 1e300) < 0.5);
  for (const auto& n : s.nodes) {
    CHECK(n.position.z > -0.5);
    CHECK(n.position.z < 99.5);
  }
}

TEST_CASE("any foreground has a skeleton", "[extract][volume]") {
  Volume one(1, 1, 1);
  one.set(0, 0, 0);
  const CurveSkeleton s = extract(one, defaults_or_small(96, 48));
  CHECK(!s.edges.empty());
  CHECK(component_count(s) == 1);
  CHECK(cycle_count(s) == 0);
  for (const auto& n : s.nodes)
    CHECK(std::max({std::abs(n.position.x), std::abs(n.position.y), std::abs(n.position.z)}) <=
          0.5);
  Random random(8);
  for (const std::uint32_t share : {1u, 5u, 9u}) {
    Volume noise(20, 15, 10);
    for (int z = 0; z < 10; ++z)
      for (int y = 0; y < 15; ++y)
        for (int x = 0; x < 20; ++x)
          if (random.below(10) < share) noise.set(x, y, z);
    const CurveSkeleton n = extract(noise, defaults_or_small(96, 48));
    CHECK(!n.edges.empty());
    CHECK(cycle_count(n) <= static_cast<int>(topology_of(noise)->tunnels));
  }
}
