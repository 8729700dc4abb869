// Homotopic thinning of images and pruning of the thin sets it leaves.
#pragma once

#include <marrow/distance_transform.hpp>

#include <span>

namespace marrow {

/// One byte per pixel, 1 in the set: faster to walk than bits. The outermost pixels are 0.
using PixelSet = Image<std::uint8_t>;

/// Thins the support of `map` in the order of its distances, without changing its topology (8 for
/// the set, 4 for the background), keeping the centres of maximal discs; then to unit width.
/// The outermost pixels of `map` are 0.
PixelSet thin_to_medial_axis(const DistanceMap& map);

/// Removes pixels, in the order given, that neither the topology needs nor are ends of `set`.
void thin_to_unit_width(PixelSet& set, std::span<const std::uint32_t> order);

/// Removes end branches from end e to the joint q where |e-q| + r_e - r_q <= `pixels`, the least
/// telling one first; a joint left with two branches is no joint any more. Leaves unit width.
void prune_end_branches(PixelSet& axis, const DistanceMap& map, double pixels);

}  // namespace marrow
