// What thinning removes for sure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shrinking_set_detail.hpp"

namespace marrow {

/// The loose pixels that thinning may keep.
struct DoubtfulPixels {
  using Bits = std::uint32_t;

  /// Adds pixels of word `i`.
  void insert(std::size_t i, Bits pixels) {
    bits[i] |= pixels;
    bits[i - 1] |= (pixels >> 1 & 1) << 31;
    bits[i + 1] |= pixels >> 30 & 1;
  }

  std::vector<Bits> bits;  // in words as the halves of those of the set
  /// For every word, for every neighbour: the pixels that it makes doubtful if it is so itself.
  std::vector<std::array<Bits, 8>> doubt_from;
};

/// Removes at once most of what thin_to_medial_axis() would remove in whatever order the pixels of
/// one distance come; the rest is thinned as it would have been. Takes a set of which nothing has
/// been removed. Where more than one loose pixel in `share` is doubtful by itself, nearly all
/// become so, and nothing is done. `room` is memory that is used again.
void remove_sure(ShrinkingSet& set, DoubtfulPixels& room, int share = 128);

}  // namespace marrow
