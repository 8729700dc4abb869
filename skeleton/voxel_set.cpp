#include <marrow/voxel_set.hpp>

namespace marrow {

VoxelSet::VoxelSet(const VoxelGrid& grid)
    : nx_(static_cast<std::uint32_t>(grid.nx)),
      ny_(static_cast<std::uint32_t>(grid.ny)),
      words_((nx_ + 63) / 64),
      bits_(words_ * ny_ * static_cast<std::size_t>(grid.nz), 0) {}

std::size_t count(const VoxelSet& set) {
  std::size_t sum = 0;
  for (const auto word : set.words()) sum += static_cast<std::size_t>(std::popcount(word));
  return sum;
}

}  // namespace marrow
