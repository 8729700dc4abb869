#include <marrow/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

/// Joins the runs of row r with those of row s that they touch; `start` says where rows begin.
void join_rows(const std::vector<VoxelRun>& runs, const std::vector<std::uint32_t>& start,
               std::size_t r, std::size_t s, DisjointSets& sets) {
  std::uint32_t i = start[r], j = start[s];
  while (i < start[r + 1] && j < start[s + 1]) {
    if (runs[i].first <= runs[j].end && runs[j].first <= runs[i].end) sets.join(i, j);
    (runs[i].end < runs[j].end ? i : j) += 1;
  }
}

}  // namespace

RunParts run_parts(const VoxelSet& set) {
  RunParts parts{voxel_runs(set), {}, 0};
  std::vector<std::uint32_t> start(set.rows() + 1, 0);
  for (const VoxelRun& run : parts.runs) ++start[run.row + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  DisjointSets sets(parts.runs.size());
  const std::size_t layer = set.rows_per_layer();
  for (std::size_t r = 0; r < set.rows(); ++r) {
    if (start[r] == start[r + 1]) continue;
    const bool is_first = r % layer == 0, is_last = r % layer == layer - 1;
    if (!is_first) join_rows(parts.runs, start, r, r - 1, sets);
    if (r < layer) continue;
    if (!is_first) join_rows(parts.runs, start, r, r - layer - 1, sets);
    join_rows(parts.runs, start, r, r - layer, sets);
    if (!is_last) join_rows(parts.runs, start, r, r - layer + 1, sets);
  }
  for (std::uint32_t i = 0; i < parts.runs.size(); ++i) {
    const std::uint32_t root = sets.root(i);
    parts.part.push_back(root == i ? parts.count++ : parts.part[root]);
  }
  return parts;
}

std::vector<std::vector<std::uint32_t>> voxel_parts(const VoxelGrid& grid, const VoxelSet& set) {
  const RunParts labelled = run_parts(set);
  std::vector<std::vector<std::uint32_t>> parts(labelled.count);
  for (std::size_t i = 0; i < labelled.runs.size(); ++i) {
    const VoxelRun& run = labelled.runs[i];
    const std::uint32_t row = run.row * static_cast<std::uint32_t>(grid.nx);
    for (int x = run.first; x < run.end; ++x)
      parts[labelled.part[i]].push_back(row + static_cast<std::uint32_t>(x));
  }
  return parts;
}

std::vector<CurveSkeleton::Edge> neighbour_pairs(const VoxelGrid& grid,
                                                 std::span<const std::uint32_t> voxels) {
  std::vector<CurveSkeleton::Edge> pairs;
  // Four of the rows around a voxel lie after its own; one hand in the list follows each of them.
  constexpr std::array<std::pair<int, int>, 4> kRows{{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  std::array<std::uint32_t, 4> hand{};
  const auto end = static_cast<std::uint32_t>(voxels.size());
  for (std::uint32_t i = 0; i < end; ++i) {
    const std::uint32_t v = voxels[i];
    const int x = grid.x_of(v), y = grid.y_of(v), z = grid.z_of(v);
    const std::uint32_t low = x > 0 ? 1 : 0, high = x + 1 < grid.nx ? 1 : 0;
    if (i + 1 < end && voxels[i + 1] == v + 1 && high != 0) pairs.push_back({i, i + 1});
    for (std::size_t r = 0; r < kRows.size(); ++r) {
      const auto [dy, dz] = kRows[r];
      if (!grid.contains(x, y + dy, z + dz)) continue;
      const std::uint32_t middle = grid.index(x, y + dy, z + dz);
      while (hand[r] < end && voxels[hand[r]] < middle - low) ++hand[r];
      for (std::uint32_t j = hand[r]; j < end && voxels[j] <= middle + high; ++j)
        pairs.push_back({i, j});
    }
  }
  return pairs;
}

}  // namespace marrow
