#include "voxel_parts_detail.hpp"

namespace marrow {

std::vector<std::vector<std::uint32_t>> voxel_parts(const VoxelGrid& grid, VoxelSet set) {
  std::vector<std::vector<std::uint32_t>> parts;
  for (std::uint32_t seed = 0; seed < set.size(); ++seed) {
    if (!set[seed]) continue;
    auto& part = parts.emplace_back(1, seed);
    set[seed] = 0;
    for (std::size_t k = 0; k < part.size(); ++k)
      for_neighbours(grid, part[k], [&](std::uint32_t n) {
        if (set[n]) set[n] = 0, part.push_back(n);
      });
  }
  return parts;
}

}  // namespace marrow
