// Exact moments of the foreground of a volume.
#pragma once

#include <marrow/volume.hpp>

#include <array>

#include "eigen_detail.hpp"

namespace marrow {

/// Lowest and highest foreground voxel along every axis.
struct VoxelBox {
  std::array<int, 3> low{}, high{};
  bool is_empty = true;
};

/// One row of foreground: its first and last voxel.
struct RowEnds {
  int first, last, y, z;
};

/// The ends of all rows that have foreground, in the order of z, y.
std::vector<RowEnds> row_ends(const Volume& volume);

/// Central moments of the voxels, as solid boxes, in units of half a voxel.
struct VoxelMoments {
  VoxelBox box;
  std::array<std::array<double, 3>, 3> second{};
  std::array<std::array<std::array<double, 3>, 3>, 3> third{};
};

/// Sums are integers about the middle of the box: what is symmetric has third moments of zero.
VoxelMoments moments_of(const Volume& volume, const std::vector<RowEnds>& rows);

}  // namespace marrow
