// Matching the two medial axes of a pair scanline by scanline, and voting (section 4.2).
#pragma once

#include <marrow/stereo_images.hpp>
#include <marrow/vote_grid.hpp>

#include <span>

namespace marrow {

/// The voxel grid for a shape: `resolution` voxels along its longest side, more (up to 192) when
/// the medial axes say that a quarter of the shape is thinner than two voxels.
VoxelGrid choose_voxel_grid(const NormalizedShape& shape, std::span<const StereoImages> views,
                            int resolution);

/// Every pair of a front and a side medial pixel on one scanline votes for the voxel that both see.
/// Thread-safe.
void cast_votes(const StereoImages& images, VoteAccumulator& accumulator);

}  // namespace marrow
