// Matching the two medial axes of a pair scanline by scanline, and voting (section 4.2).
#pragma once

#include <marrow/stereo_images.hpp>
#include <marrow/vote_grid.hpp>

namespace marrow {

/// Every pair of a front and a side medial pixel on one scanline votes for the voxel that both see.
/// Thread-safe.
void cast_votes(const StereoImages& images, VoteAccumulator& accumulator);

}  // namespace marrow
