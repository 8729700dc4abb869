#include <marrow/homotopic_thinning.hpp>

#include <simple_point_detail.hpp>

#include "catch.hpp"
#include "mesh_checks.hpp"
#include "random.hpp"
#include "scale.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Whether bit i of a neighbourhood, or the voxel itself, is the voxel at this offset.
bool has(Neighbourhood bits, int x, int y, int z) {
  const int k = (x + 1) + 3 * (y + 1) + 9 * (z + 1);
  if (k == 13) return false;
  return bits >> (k < 13 ? k : k - 1) & 1;
}

/// A cell on the boundary of a cube: two coordinates in -1, 0, 1 off 0 make an edge, three a
/// corner.
struct Cell {
  int x, y, z;
  int dimension() const { return 3 - (x != 0) - (y != 0) - (z != 0); }
};

/// Whether a neighbour of the voxel has this cell of the voxel's boundary.
bool is_covered(Neighbourhood bits, const Cell& c) {
  for (int x = std::min(c.x, 0); x <= std::max(c.x, 0); ++x)
    for (int y = std::min(c.y, 0); y <= std::max(c.y, 0); ++y)
      for (int z = std::min(c.z, 0); z <= std::max(c.z, 0); ++z)
        if (has(bits, x, y, z)) return true;
  return false;
}

/// Kong (1995): a voxel is simple when the part of its boundary that it shares with the set is
/// contractible; on a sphere: when it is connected and has Euler number 1. This knows nothing of
/// adjacency in the neighbourhood.
bool is_simple_by_definition(Neighbourhood bits) {
  std::vector<Cell> cells;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if ((x != 0 || y != 0 || z != 0) && is_covered(bits, {x, y, z})) cells.push_back({x, y, z});
  if (cells.empty()) return false;
  Groups pieces(cells.size());
  int euler = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& a = cells[i];
    euler += a.dimension() == 1 ? -1 : 1;
    for (std::size_t j = 0; j < i; ++j) {
      const Cell& b = cells[j];
      // One is in the closure of the other: where the lower one is 0 so is the other.
      const auto within = [](const Cell& f, const Cell& g) {
        return (f.x == 0 || f.x == g.x) && (f.y == 0 || f.y == g.y) && (f.z == 0 || f.z == g.z);
      };
      if (within(a, b) || within(b, a)) pieces.join(i, j);
    }
  }
  return pieces.count() == 1 && euler == 1;
}

VoxelGrid cube_grid(int side) { return {{0, 0, 0}, 1, side, side, side}; }

struct Topology {
  int components = 0, tunnels = 0, cavities = 0;

  friend bool operator==(const Topology&, const Topology&) = default;
};

std::ostream& operator<<(std::ostream& out, const Topology& t) {
  return out << t.components << " parts, " << t.tunnels << " tunnels, " << t.cavities
             << " cavities";
}

/// Parts of the voxels that are `value`, where `steps` coordinates may differ between neighbours.
int count_parts(const VoxelGrid& g, const VoxelSet& set, bool value, int steps) {
  Groups parts(set.size());
  int others = 0;
  for (std::uint32_t v = 0; v < set.size(); ++v) {
    if ((set[v] != 0) != value) {
      ++others;
      continue;
    }
    for (int k = 0; k < 27; ++k) {
      const int dx = k % 3 - 1, dy = k / 3 % 3 - 1, dz = k / 9 - 1;
      if (std::abs(dx) + std::abs(dy) + std::abs(dz) > steps) continue;
      const int x = g.x_of(v) + dx, y = g.y_of(v) + dy, z = g.z_of(v) + dz;
      if (!g.contains(x, y, z)) continue;
      const auto n = g.index(x, y, z);
      if ((set[n] != 0) == value) parts.join(v, n);
    }
  }
  return parts.count() - others;
}

/// Corners - edges + faces - cubes of the union of closed cubes.
int euler_number(const VoxelGrid& g, const VoxelSet& set) {
  int sum = 0;
  for (int z = 0; z <= 2 * g.nz; ++z)
    for (int y = 0; y <= 2 * g.ny; ++y)
      for (int x = 0; x <= 2 * g.nx; ++x) {
        // Odd coordinates run along the cell; around an even one lie two voxels.
        bool covered = false;
        for (int k = 0; k < 8; ++k) {
          const int vx = (x - (k & 1)) >> 1, vy = (y - (k >> 1 & 1)) >> 1, vz = (z - (k >> 2)) >> 1;
          if (g.contains(vx, vy, vz)) covered |= set[g.index(vx, vy, vz)] != 0;
        }
        if (covered) sum += (x + y + z) % 2 == 0 ? 1 : -1;
      }
  return sum;
}

Topology topology_of(const VoxelGrid& g, const VoxelSet& set) {
  Topology t;
  t.components = count_parts(g, set, true, 3);
  t.cavities = count_parts(g, set, false, 1) - 1;
  t.tunnels = t.components + t.cavities - euler_number(g, set);
  return t;
}

/// Random boxes put in and taken out, and some single voxels of both kinds; nothing on the faces of
/// the grid.
VoxelSet random_set(const VoxelGrid& g, Random& random) {
  VoxelSet set(g.count(), 0);
  const auto below = [&](int n) {
    return static_cast<int>(random.below(static_cast<std::uint32_t>(n)));
  };
  const auto fill = [&](int most_side, std::uint8_t value) {
    const auto place = [&] { return 1 + below(g.nx - 2); };
    const int x0 = place(), y0 = place(), z0 = place();
    for (int z = z0; z < std::min(g.nz - 1, z0 + 1 + below(most_side)); ++z)
      for (int y = y0; y < std::min(g.ny - 1, y0 + most_side); ++y)
        for (int x = x0; x < std::min(g.nx - 1, x0 + most_side); ++x) set[g.index(x, y, z)] = value;
  };
  for (int i = 0; i < 12; ++i) {
    fill(6, 1);
    fill(3, 0);
  }
  for (int i = 0; i < 40; ++i) fill(1, static_cast<std::uint8_t>(i % 2));
  return set;
}

Neighbourhood neighbourhood_of(const VoxelGrid& g, const VoxelSet& set, std::uint32_t v) {
  Neighbourhood bits = 0;
  for (int k = 0, bit = 0; k < 27; ++k) {
    if (k == 13) continue;
    const auto n = g.index(g.x_of(v) + k % 3 - 1, g.y_of(v) + k / 3 % 3 - 1, g.z_of(v) + k / 9 - 1);
    bits |= Neighbourhood{set[n] != 0} << bit++;
  }
  return bits;
}

}  // namespace

TEST_CASE("a voxel is simple when its attachment is contractible", "[homotopic_thinning]") {
  Random random(1);
  int simple = 0;
  const int samples = scaled(400'000, 10'000);
  for (int i = 0; i < samples; ++i) {
    // Few and many neighbours: evenly drawn bits would hardly ever be simple.
    const double density = random.unit();
    Neighbourhood bits = 0;
    for (int b = 0; b < 26; ++b) bits |= Neighbourhood{random.unit() < density} << b;
    const bool expected = is_simple_by_definition(bits);
    simple += expected;
    if (is_simple(bits) != expected) FAIL("neighbourhood " << bits << " is not " << expected);
  }
  CHECK(simple > samples / 20);
  CHECK(simple < samples * 19 / 20);
}

TEST_CASE("the plainest neighbourhoods", "[homotopic_thinning]") {
  CHECK_FALSE(is_simple(0));                               // a part of its own
  CHECK_FALSE(is_simple((1u << 26) - 1));                  // inside: removal would make a cavity
  for (int b = 0; b < 26; ++b) CHECK(is_simple(1u << b));  // the end of a line
  CHECK_FALSE(is_simple(1u << 12 | 1u << 13));             // the middle of a line
}

TEST_CASE("thinning keeps parts, tunnels and cavities", "[homotopic_thinning]") {
  Random random(2);
  int tunnels = 0, cavities = 0;
  for (int round = 0; round < scaled(150, 12); ++round) {
    const VoxelGrid g = cube_grid(12);
    const VoxelSet set = random_set(g, random);
    std::vector<std::uint16_t> key(g.count());
    for (auto& k : key) k = static_cast<std::uint16_t>(random.below(50));
    std::vector<std::uint32_t> anchors;
    for (int i = 0; i < round % 7; ++i)  // also where nothing is
      anchors.push_back(random.below(static_cast<std::uint32_t>(g.count())));

    const VoxelSet thin_set = thin(g, set, key, anchors);
    INFO("round " << round);
    const Topology before = topology_of(g, set);
    CHECK(topology_of(g, thin_set) == before);
    tunnels += before.tunnels;
    cavities += before.cavities;
    bool is_subset = true, has_removable = false;
    for (std::uint32_t v = 0; v < set.size(); ++v) {
      if (!thin_set[v]) continue;
      is_subset = is_subset && set[v] && thin_set[v] == 1;
      const bool is_anchor = std::find(anchors.begin(), anchors.end(), v) != anchors.end();
      if (!is_anchor && is_simple_by_definition(neighbourhood_of(g, thin_set, v)))
        has_removable = true;
    }
    CHECK(is_subset);
    CHECK_FALSE(has_removable);
    for (const auto a : anchors) CHECK((thin_set[a] != 0) == (set[a] != 0));
  }
  CHECK(tunnels > 0);  // else the sets were too plain to say anything
  CHECK(cavities > 0);
}

TEST_CASE("the lowest keys go first, ties by lower index", "[homotopic_thinning]") {
  // A slab of one layer: what is left of it without anchors is the voxel that goes last.
  const VoxelGrid g = cube_grid(9);
  VoxelSet slab(g.count(), 0);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x) slab[g.index(x, y, 4)] = 1;
  std::vector<std::uint16_t> key(g.count(), 5);
  const auto last = [&] {
    const VoxelSet left = thin(g, slab, key, {});
    REQUIRE(std::count(left.begin(), left.end(), 1) == 1);
    return static_cast<std::uint32_t>(std::find(left.begin(), left.end(), 1) - left.begin());
  };
  CHECK(last() == g.index(6, 6, 4));
  key[g.index(3, 4, 4)] = 9;
  CHECK(last() == g.index(3, 4, 4));
}

TEST_CASE("anchors at both ends leave a line between them", "[homotopic_thinning]") {
  const VoxelGrid g = cube_grid(20);
  VoxelSet bar(g.count(), 0);
  for (int z = 8; z < 13; ++z)
    for (int y = 8; y < 13; ++y)
      for (int x = 2; x < 18; ++x) bar[g.index(x, y, z)] = 1;
  const auto key = distance_transform(g, bar);
  const std::vector<std::uint32_t> anchors{g.index(2, 10, 10), g.index(17, 10, 10)};
  const VoxelSet line = thin(g, bar, key, anchors);
  CHECK(std::count(line.begin(), line.end(), 1) == 16);
  for (int x = 5; x < 15; ++x) CHECK(line[g.index(x, 10, 10)] == 1);  // depth decides
}

TEST_CASE("the distance transform is the least (3,4,5) path", "[homotopic_thinning]") {
  Random random(3);
  for (unsigned round = 0; round < 4; ++round) {
    const VoxelGrid g{{0, 0, 0}, 1, 11, 9, 13};
    VoxelSet set(g.count(), 0);
    for (int z = 1; z < g.nz - 1; ++z)
      for (int y = 1; y < g.ny - 1; ++y)
        for (int x = 1; x < g.nx - 1; ++x)
          set[g.index(x, y, z)] = random.below(100) < 100 - 2 * round;
    const auto got = distance_transform(g, set);
    bool same = true;
    for (std::uint32_t v = 0; v < set.size(); ++v) {
      int least = 1 << 20;
      for (std::uint32_t w = 0; w < set.size(); ++w) {
        if (set[w]) continue;
        std::array<int, 3> d{std::abs(g.x_of(v) - g.x_of(w)), std::abs(g.y_of(v) - g.y_of(w)),
                             std::abs(g.z_of(v) - g.z_of(w))};
        std::sort(d.begin(), d.end());
        least = std::min(least, 5 * d[0] + 4 * (d[1] - d[0]) + 3 * (d[2] - d[1]));
      }
      same = same && got[v] == least;
    }
    CHECK(same);
  }
}
