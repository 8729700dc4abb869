// Neighbours and connected parts of voxel sets.
#pragma once

#include <marrow/visual_hull.hpp>

#include <vector>

namespace marrow {

/// Calls visit(index) for the 26 neighbours of a voxel that lie in the grid, in index order.
template <class Visit>
void for_neighbours(const VoxelGrid& g, std::uint32_t voxel, Visit visit) {
  const int x = g.x_of(voxel), y = g.y_of(voxel), z = g.z_of(voxel);
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if ((dx != 0 || dy != 0 || dz != 0) && g.contains(x + dx, y + dy, z + dz))
          visit(g.index(x + dx, y + dy, z + dz));
}

/// Voxels of the 26-connected parts of `set`, part by part, in the order of their lowest index.
std::vector<std::vector<std::uint32_t>> voxel_parts(const VoxelGrid& grid, VoxelSet set);

}  // namespace marrow
