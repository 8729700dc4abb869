#include <marrow/disjoint_sets.hpp>
#include <marrow/gap_bridging.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "live_graph_detail.hpp"
#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr double kStraight = 0.5;  // cosine between the end of a branch and its bridge
constexpr std::uint32_t kNone = ~0U;

/// Which part of a set every voxel belongs to; kNone for those of none.
struct VoxelLabels {
  std::vector<std::uint32_t> part;
  std::size_t count = 0;

  VoxelLabels(const VoxelGrid& grid, const VoxelSet& set) : part(grid.count(), kNone) {
    const auto parts = voxel_parts(grid, set);
    count = parts.size();
    for (std::uint32_t i = 0; i < count; ++i)
      for (const auto v : parts[i]) part[v] = i;
  }
};

struct Bridge {
  double length = 0;
  std::uint32_t from = 0, to = 0;  // voxels

  auto key() const { return std::tuple(length, from, to); }
};

/// Where the branch that ends at a leaf is going, seen over the radius of the leaf; nothing for a
/// part of one node.
std::optional<Vec3> direction_of(const LiveGraph& core, NodeId leaf) {
  const Vec3 end = core.node(leaf).position;
  const double wanted = core.node(leaf).radius;
  for (const NodeId n : trace_leaf_branch(core, leaf).nodes) {
    const Vec3 back = end - core.node(n).position;
    if (length(back) >= wanted) return normalized(back);
  }
  return {};
}

/// The nearest voxel of another part ahead of a leaf, no farther from its ball than `reach`.
std::optional<Bridge> bridge_from(const VoxelGrid& grid, const VoxelLabels& labels,
                                  const LiveGraph& core, NodeId leaf, double reach) {
  const auto direction = direction_of(core, leaf);
  if (!direction) return {};
  const VoteGraph::Node& node = core.node(leaf);
  const std::uint32_t own = labels.part[node.voxel];
  const double farthest = node.radius + reach;
  const int at_y = grid.y_of(node.voxel), at_z = grid.z_of(node.voxel);
  std::optional<Bridge> best;
  // A voxel this many away along one axis is at least one less away in all.
  const auto may_be_nearer = [&](int voxels) {
    return (voxels - 1) * grid.size <= (best ? best->length : farthest);
  };
  const auto look_along = [&](int y, int z) {
    for (int x = 0; x < grid.nx; ++x) {
      const std::uint32_t v = grid.index(x, y, z);
      if (labels.part[v] == kNone || labels.part[v] == own) continue;
      const Vec3 way = grid.center(x, y, z) - node.position;
      const Bridge bridge{length(way), node.voxel, v};
      if (bridge.length > farthest || dot(way, *direction) < kStraight * bridge.length) continue;
      if (!best || bridge.key() < best->key()) best = bridge;
    }
  };
  for (int dz = 0; dz < grid.nz && may_be_nearer(dz); ++dz)
    for (const int z : {at_z - dz, at_z + dz})
      for (int dy = 0; z >= 0 && z < grid.nz && dy < grid.ny && may_be_nearer(dy); ++dy)
        for (const int y : {at_y - dy, at_y + dy})
          if (y >= 0 && y < grid.ny) look_along(y, z);
  return best;
}

void draw_line(VoxelSet& set, const VoxelGrid& grid, const Bridge& bridge) {
  const Vec3 from = grid.center(bridge.from), to = grid.center(bridge.to);
  const int steps = 2 * static_cast<int>(std::ceil(length(to - from) / grid.size)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p =
        (from + (to - from) * (static_cast<double>(i) / steps) - grid.origin) / grid.size;
    set.insert(grid.index(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)));
  }
}

}  // namespace

VoxelSet bridge_gaps(const VoxelGrid& grid, VoxelSet hull, const VoteGraph& core, double reach) {
  VoxelSet whole = hull;
  for (const auto& node : core.nodes) whole.insert(node.voxel);
  const VoxelLabels labels(grid, whole);
  if (labels.count < 2) return hull;
  const LiveGraph live(core);
  std::vector<Bridge> bridges;
  for (NodeId n = 0; n < live.size(); ++n)
    if (live.degree(n) == 1)
      if (const auto bridge = bridge_from(grid, labels, live, n, reach)) bridges.push_back(*bridge);
  std::sort(bridges.begin(), bridges.end(),
            [](const Bridge& a, const Bridge& b) { return a.key() < b.key(); });
  DisjointSets joined(labels.count);
  for (const Bridge& bridge : bridges)
    if (joined.join(labels.part[bridge.from], labels.part[bridge.to]))
      draw_line(hull, grid, bridge);
  return hull;
}

}  // namespace marrow
