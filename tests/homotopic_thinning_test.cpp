#include <marrow/homotopic_thinning.hpp>

#include <simple_point_detail.hpp>

#include <map>
#include <set>

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
  return bits >> k & 1;
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
  Groups parts(g.count());
  int others = 0;
  for (std::uint32_t v = 0; v < g.count(); ++v) {
    if (set[v] != value) {
      ++others;
      continue;
    }
    for (int k = 0; k < 27; ++k) {
      const int dx = k % 3 - 1, dy = k / 3 % 3 - 1, dz = k / 9 - 1;
      if (std::abs(dx) + std::abs(dy) + std::abs(dz) > steps) continue;
      const int x = g.x_of(v) + dx, y = g.y_of(v) + dy, z = g.z_of(v) + dz;
      if (!g.contains(x, y, z)) continue;
      const auto n = g.index(x, y, z);
      if (set[n] == value) parts.join(v, n);
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
          if (g.contains(vx, vy, vz)) covered |= set[g.index(vx, vy, vz)];
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
  VoxelSet set(g);
  const auto below = [&](int n) {
    return static_cast<int>(random.below(static_cast<std::uint32_t>(n)));
  };
  const auto fill = [&](int most_side, bool value) {
    const auto place = [&] { return 1 + below(g.nx - 2); };
    const int x0 = place(), y0 = place(), z0 = place();
    for (int z = z0; z < std::min(g.nz - 1, z0 + 1 + below(most_side)); ++z)
      for (int y = y0; y < std::min(g.ny - 1, y0 + most_side); ++y)
        for (int x = x0; x < std::min(g.nx - 1, x0 + most_side); ++x)
          value ? set.insert(g.index(x, y, z)) : set.erase(g.index(x, y, z));
  };
  for (int i = 0; i < 12; ++i) {
    fill(6, true);
    fill(3, false);
  }
  for (int i = 0; i < 40; ++i) fill(1, i % 2 == 1);
  return set;
}

Neighbourhood neighbourhood_of(const VoxelGrid& g, const VoxelSet& set, std::uint32_t v) {
  Neighbourhood bits = 0;
  for (int k = 0; k < 27; ++k) {
    const auto n = g.index(g.x_of(v) + k % 3 - 1, g.y_of(v) + k / 3 % 3 - 1, g.z_of(v) + k / 9 - 1);
    bits |= Neighbourhood{set[n]} << k;
  }
  return bits;
}

/// What the header promises, by a queue of keys and voxels.
VoxelSet thin_slowly(const VoxelGrid& g, VoxelSet set, const std::vector<std::uint16_t>& key,
                     const std::vector<std::uint32_t>& anchors) {
  using Entry = std::pair<std::uint16_t, std::uint32_t>;
  std::map<std::uint32_t, std::uint16_t> key_of;
  set.for_each([&](std::uint32_t v) { key_of.emplace(v, key[key_of.size()]); });
  std::set<Entry> queue;
  const auto push = [&](std::uint32_t v) {
    constexpr Neighbourhood kFaces = 1u << 4 | 1u << 10 | 1u << 12 | 1u << 14 | 1u << 16 | 1u << 22;
    if (!set[v] || std::find(anchors.begin(), anchors.end(), v) != anchors.end()) return;
    if ((neighbourhood_of(g, set, v) & kFaces) != kFaces) queue.insert({key_of.at(v), v});
  };
  for (const auto& [v, k] : key_of) push(v);
  while (!queue.empty()) {
    const std::uint32_t v = queue.begin()->second;
    queue.erase(queue.begin());
    if (!is_simple(neighbourhood_of(g, set, v))) continue;
    set.erase(v);
    for (int k = 0; k < 27; ++k)
      push(g.index(g.x_of(v) + k % 3 - 1, g.y_of(v) + k / 3 % 3 - 1, g.z_of(v) + k / 9 - 1));
  }
  return set;
}

}  // namespace

TEST_CASE("a voxel is simple when its attachment is contractible", "[homotopic_thinning]") {
  Random random(1);
  SimplePoints remembered;
  int simple = 0;
  const int samples = scaled(400'000, 10'000);
  for (int i = 0; i < samples; ++i) {
    // Few and many neighbours: evenly drawn bits would hardly ever be simple.
    const double density = random.unit();
    Neighbourhood bits = 0;
    for (int b = 0; b < 27; ++b) bits |= Neighbourhood{random.unit() < density} << b;
    const bool expected = is_simple_by_definition(bits);
    simple += expected;
    if (is_simple(bits) != expected) FAIL("neighbourhood " << bits << " is not " << expected);
    if (remembered(bits) != expected) FAIL("neighbourhood " << bits << " is remembered wrongly");
  }
  CHECK(simple > samples / 20);
  CHECK(simple < samples * 19 / 20);
}

TEST_CASE("the plainest neighbourhoods", "[homotopic_thinning]") {
  CHECK_FALSE(is_simple(0));                    // a part of its own
  CHECK_FALSE(is_simple((1u << 27) - 1));       // inside: removal would make a cavity
  CHECK_FALSE(is_simple(1u << 12 | 1u << 14));  // the middle of a line
  for (int b = 0; b < 27; ++b)
    CHECK(is_simple(1u << b) == (b != 13));  // the end of a line; the voxel itself plays no part
}

TEST_CASE("thinning keeps parts, tunnels and cavities", "[homotopic_thinning]") {
  Random random(2);
  int tunnels = 0, cavities = 0;
  for (int round = 0; round < scaled(150, 12); ++round) {
    const VoxelGrid g = cube_grid(12);
    const VoxelSet set = random_set(g, random);
    std::vector<std::uint16_t> key(count(set));
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
    for (std::uint32_t v = 0; v < g.count(); ++v) {
      if (!thin_set[v]) continue;
      is_subset = is_subset && set[v];
      const bool is_anchor = std::find(anchors.begin(), anchors.end(), v) != anchors.end();
      if (!is_anchor && is_simple_by_definition(neighbourhood_of(g, thin_set, v)))
        has_removable = true;
    }
    CHECK(is_subset);
    CHECK_FALSE(has_removable);
    for (const auto a : anchors) CHECK(thin_set[a] == set[a]);
  }
  CHECK(tunnels > 0);  // else the sets were too plain to say anything
  CHECK(cavities > 0);
}

TEST_CASE("the lowest keys go first, ties by lower index", "[homotopic_thinning]") {
  // A slab of one layer: what is left of it without anchors is the voxel that goes last.
  const VoxelGrid g = cube_grid(9);
  VoxelSet slab(g);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x) slab.insert(g.index(x, y, 4));
  std::vector<std::uint16_t> key(count(slab), 5);
  const auto last = [&] {
    std::vector<std::uint32_t> left;
    thin(g, slab, key, {}).for_each([&](std::uint32_t v) { left.push_back(v); });
    REQUIRE(left.size() == 1);
    return left[0];
  };
  CHECK(last() == g.index(6, 6, 4));
  key[2 * 5 + 1] = 9;
  CHECK(last() == g.index(3, 4, 4));
}

TEST_CASE("thinning goes one voxel after the other", "[homotopic_thinning]") {
  Random random(4);
  for (int round = 0; round < scaled(60, 6); ++round) {
    const VoxelGrid g{{0, 0, 0}, 1, 61 + round % 12, 11, 10};  // some rows end at a word's end
    VoxelSet set(g);
    const VoxelSet low = random_set(cube_grid(10), random);
    low.for_each([&](std::uint32_t v) {
      const VoxelGrid cube = cube_grid(10);
      set.insert(g.index(cube.x_of(v) + g.nx - 10, cube.y_of(v), cube.z_of(v)));
    });
    std::vector<std::uint16_t> key(count(set));
    for (auto& k : key) k = static_cast<std::uint16_t>(random.below(round % 2 == 0 ? 6 : 60000));
    std::vector<std::uint32_t> anchors;
    for (int i = 0; i < round % 5; ++i)
      anchors.push_back(random.below(static_cast<std::uint32_t>(g.count())));
    INFO("round " << round);
    CHECK(thin(g, set, key, anchors) == thin_slowly(g, set, key, anchors));
  }
}

TEST_CASE("anchors at both ends leave a line between them", "[homotopic_thinning]") {
  const VoxelGrid g = cube_grid(20);
  VoxelSet bar(g);
  for (int z = 8; z < 13; ++z)
    for (int y = 8; y < 13; ++y)
      for (int x = 2; x < 18; ++x) bar.insert(g.index(x, y, z));
  const auto key = distance_transform(g, bar);
  const std::vector<std::uint32_t> anchors{g.index(2, 10, 10), g.index(17, 10, 10)};
  const VoxelSet line = thin(g, bar, key, anchors);
  CHECK(count(line) == 16);
  for (int x = 5; x < 15; ++x) CHECK(line[g.index(x, 10, 10)]);  // depth decides
}

TEST_CASE("the distance transform is the least (3,4,5) path", "[homotopic_thinning]") {
  Random random(3);
  for (unsigned round = 0; round < 4; ++round) {
    const VoxelGrid g{{0, 0, 0}, 1, 11, 9, 13};
    VoxelSet set(g);
    for (int z = 1; z < g.nz - 1; ++z)
      for (int y = 1; y < g.ny - 1; ++y)
        for (int x = 1; x < g.nx - 1; ++x)
          if (random.below(100) < 100 - 2 * round) set.insert(g.index(x, y, z));
    const auto got = distance_transform(g, set);
    REQUIRE(got.size() == count(set));
    bool same = true;
    auto depth = got.begin();
    set.for_each([&](std::uint32_t v) {
      int least = 1 << 20;
      for (std::uint32_t w = 0; w < g.count(); ++w) {
        if (set[w]) continue;
        std::array<int, 3> d{std::abs(g.x_of(v) - g.x_of(w)), std::abs(g.y_of(v) - g.y_of(w)),
                             std::abs(g.z_of(v) - g.z_of(w))};
        std::sort(d.begin(), d.end());
        least = std::min(least, 5 * d[0] + 4 * (d[1] - d[0]) + 3 * (d[2] - d[1]));
      }
      same = same && *depth++ == least;
    });
    CHECK(same);
  }
}
