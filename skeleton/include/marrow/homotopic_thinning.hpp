// Ordered homotopic thinning of a voxel set.
#pragma once

#include <marrow/voxel_set.hpp>

#include <span>

namespace marrow {

/// (3,4,5) chamfer distance of the voxels of `set` to its complement, in thirds of a voxel, in the
/// order of the voxels. No voxel of `set` may lie on the outermost layer of the grid.
std::vector<ChamferDistance> distance_transform(const VoxelGrid& grid, const VoxelSet& set);

/// Removes simple border voxels of `set`, lowest key first, ties by lower index, until none is
/// left: the topology (26 for the set, 6 for the rest) is that of `set`, and the voxels of
/// `anchors` stay. `key` has one value for each voxel of `set`, in their order. No voxel of `set`
/// may lie on the outermost layer of the grid.
VoxelSet thin(const VoxelGrid& grid, VoxelSet set, std::span<const std::uint16_t> key,
              std::span<const std::uint32_t> anchors);

}  // namespace marrow
