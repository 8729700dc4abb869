// From a closed mesh to a volume.
#pragma once

#include <marrow/shape.hpp>
#include <marrow/volume.hpp>

namespace marrow {

/// The voxels whose centres lie inside `shape`, where its winding number is not zero: cubes,
/// `voxels` of them (8 to 1024) along the longest side of its box, and one layer of background
/// around it. Exact on a lattice of a 4096th of a voxel. Of an open shape nothing sensible.
Volume voxelise(const Shape& shape, int voxels);

}  // namespace marrow
