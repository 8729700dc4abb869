// Homotopic thinning of images and pruning of the thin sets it leaves.
#pragma once

#include <marrow/distance_transform.hpp>

namespace marrow {

/// One byte per pixel, 1 in the set: faster to walk than bits. The outermost pixels are 0.
using PixelSet = Image<std::uint8_t>;

/// Thins the support of `map` in the order of its distances, without changing its topology (8 for
/// the set, 4 for the background), keeping the centres of maximal discs; then to unit width.
PixelSet thin_to_medial_axis(const DistanceMap& map);

/// Removes end branches from end e to the joint q where |e-q| + r_e - r_q <= `pixels`, the least
/// telling one first; a joint left with two branches is no joint any more.
void prune_end_branches(PixelSet& axis, const DistanceMap& map, double pixels);

}  // namespace marrow
