// Runs of voxels along x.
#pragma once

#include <marrow/voxel_set.hpp>

#include <vector>

namespace marrow {

/// The voxels first <= x < end of a row of a VoxelSet; a longest such run.
struct VoxelRun {
  std::uint32_t row;
  int first, end;

  int size() const { return end - first; }
};

/// All runs of the set in the order of their voxels.
std::vector<VoxelRun> voxel_runs(const VoxelSet& set);

/// Takes the voxels of a run out of the set.
void erase(VoxelSet& set, const VoxelRun& run);

}  // namespace marrow
