// Homotopic thinning of images and pruning of the thin sets it leaves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shrinking_set_detail.hpp"

namespace marrow {

/// Pixels by distance; room that is used again.
struct PixelOrder {
  std::vector<std::uint32_t> start;  // of every distance
  std::vector<ShrinkingSet::Pixel> pixels;
};

/// Thins `set` in the order of its distances (at most 0x7fff), without changing its topology (8 for
/// the set, 4 for the background), keeping the centres of maximal discs; then to unit width.
void thin_to_medial_axis(ShrinkingSet& set, PixelOrder& order);

/// Removes pixels, in the order given, that neither the topology needs nor are ends of `set`.
void thin_to_unit_width(ShrinkingSet& set, std::span<const ShrinkingSet::Pixel> order);

/// Removes end branches from end e to the joint q where |e-q| + r_e - r_q <= `most`, the least
/// telling one first; a joint left with two branches is no joint any more. Leaves unit width.
void prune_end_branches(ShrinkingSet& axis, double most);

}  // namespace marrow
