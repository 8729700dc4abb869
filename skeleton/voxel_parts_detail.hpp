// Neighbours and connected parts of voxels.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/voxel_set.hpp>

#include <span>
#include <vector>

#include "voxel_runs_detail.hpp"

namespace marrow {

/// All pairs of 26-neighbours among `voxels`, which are in the order of their indices: positions in
/// the list, lower one first, in lexicographic order.
std::vector<CurveSkeleton::Edge> neighbour_pairs(const VoxelGrid& grid,
                                                 std::span<const std::uint32_t> voxels);

/// The runs of a set, and for each the number of the 26-connected part that it lies in.
struct RunParts {
  std::vector<VoxelRun> runs;
  std::vector<std::uint32_t> part;  ///< of each run; parts in the order of their lowest voxel
  std::uint32_t count = 0;          ///< of parts
};
RunParts run_parts(const VoxelSet& set);

/// Voxels of the 26-connected parts of `set`, part by part, in the order of their lowest index.
std::vector<std::vector<std::uint32_t>> voxel_parts(const VoxelGrid& grid, const VoxelSet& set);

}  // namespace marrow
