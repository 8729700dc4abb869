// What thinning removes for sure, 30 pixels at a time.
//
// When a pixel first comes up, all deeper neighbours are there, and so are the centres of maximal
// discs. It is plain if it is simple with these, with none of the loose ones that are less deep,
// and with any of those that are as deep. It is doubtful if it is loose and not plain, or has a
// doubtful neighbour that is as deep or less: what is loose otherwise is sure. Level by level, the
// sure go when they first come up: of the neighbours as deep or less only sure ones are loose, and
// the less deep of these have gone. And no doubtful pixel ever sees a sure one that is as deep or
// deeper: nothing changes for it when all sure ones go at once before.
#include <algorithm>
#include <bit>

#include "sure_removal_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sure_removal.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "mask_bits_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::int16_t, 32>;
using Bits = DoubtfulPixels::Bits;

/// What is at one neighbour of 32 pixels: where it is there for sure, where it may be, and where it
/// is not deeper.
struct Neighbour {
  Bits surely = 0, maybe = 0, not_deeper = 0;
};

/// The eight around, counter-clockwise from the right.
using Ring = std::array<Neighbour, 8>;

constexpr std::array<int, 8> kRight{1, 1, 0, -1, -1, -1, 0, 1}, kDown{0, -1, -1, -1, 0, 1, 1, 1};

/// The bits of a row as those pixels see them that lie `right` before; the outermost are not right.
HWY_INLINE Bits seen(Bits row, int right) {
  return right == 0 ? row : right > 0 ? row >> 1 : row << 1;
}

HWY_INLINE Ring ring_of(const ShrinkingSet& set, std::size_t word) {
  const Tag d;
  const std::ptrdiff_t per_row = set.words_per_row();
  const auto* distance = reinterpret_cast<const std::int16_t*>(set.distances_of_word(word));
  Ring ring;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::ptrdiff_t to = 32 * per_row * kDown[k] + kRight[k];
    Bits deeper = 0, less_deep = 0;
    for (std::size_t i = 0; i < 32; i += hn::Lanes(d)) {
      const auto here = hn::LoadU(d, distance + i), there = hn::LoadU(d, distance + i + to);
      deeper |= bits_of(d, hn::Gt(there, here)) << i;
      less_deep |= bits_of(d, hn::Lt(there, here)) << i;
    }
    const std::uint64_t row = set.words()[word + static_cast<std::size_t>(per_row * kDown[k])];
    const Bits centres = seen(static_cast<Bits>(row & ~(row >> 32)), kRight[k]);
    ring[k] = {deeper | centres, ~less_deep | centres, ~deeper};
  }
  return ring;
}

/// Where exactly one piece of the set touches the pixel across a gap, whatever is there of what may
/// be: is_simple() of thinning.cpp.
HWY_INLINE Bits simple_for_all(const Ring& ring) {
  const auto open = [&](std::size_t k) { return ~ring[k % 8].surely; };
  const auto some = [&](std::size_t k) { return ring[k % 8].maybe; };
  const auto crossing = [&](std::size_t k) { return open(k) & (some(k + 1) | some(k + 2)); };
  Bits none = ~Bits{0}, interior = ~Bits{0};
  Bits two = (crossing(0) & crossing(4)) | (crossing(2) & crossing(6));
  for (std::size_t k = 0; k < 8; ++k) none &= open(k);
  for (std::size_t k = 0; k < 8; k += 2) {
    interior &= some(k);
    // One after the other: the pixel between them is missing.
    two |= open(k) & some(k + 1) & crossing(k + 2);
  }
  return ~(none | interior | two);
}

/// What is not plain; false as soon as that is more than one loose pixel in `share`.
bool find_not_plain(const ShrinkingSet& set, DoubtfulPixels& pixels, int share) {
  const auto row = static_cast<std::size_t>(set.words_per_row());
  const std::size_t words = set.word_count();
  pixels.bits.assign(words, 0);
  pixels.doubt_from.resize(words);
  int left = 0;  // that need not be plain
  for (std::size_t i = 0; i < words; ++i) left += std::popcount(set.loose_in_word(i));
  left /= share;
  for (std::size_t i = row; i + row < words; ++i) {
    const Bits loose = set.loose_in_word(i);
    pixels.doubt_from[i] = {};
    if (loose == 0) continue;
    const Ring ring = ring_of(set, i);
    for (std::size_t k = 0; k < 8; ++k) pixels.doubt_from[i][k] = loose & ring[k].not_deeper;
    const Bits not_plain = loose & ~simple_for_all(ring);
    pixels.insert(i, not_plain);
    left -= std::popcount(not_plain);
    if (left < 0) return false;
  }
  return true;
}

/// Lets doubt come to a word from those around it; whether any did.
HWY_INLINE bool spread_to(DoubtfulPixels& pixels, std::size_t i, std::size_t row) {
  const Bits before = pixels.bits[i], above = pixels.bits[i - row], below = pixels.bits[i + row];
  if ((before | above | below) == 0) return false;
  const auto& from = pixels.doubt_from[i];
  Bits fresh = 0, here = before;
  for (std::size_t k = 1; k <= 3; ++k) fresh |= from[k] & seen(above, kRight[k]);
  for (std::size_t k = 5; k <= 7; ++k) fresh |= from[k] & seen(below, kRight[k]);
  for (;;) {
    fresh |= (from[0] & seen(here, 1)) | (from[4] & seen(here, -1));
    if ((fresh & ~here) == 0) break;
    here |= fresh;
  }
  if (here == before) return false;
  pixels.insert(i, here);
  return true;
}

/// Down and up again, until nothing changes.
void spread(DoubtfulPixels& pixels, std::size_t row) {
  for (bool is_any = true; is_any;) {
    is_any = false;
    for (std::size_t i = row; i + row < pixels.bits.size(); ++i)
      is_any |= spread_to(pixels, i, row);
    if (!is_any) return;
    is_any = false;
    for (std::size_t i = pixels.bits.size() - row; i-- > row;) is_any |= spread_to(pixels, i, row);
  }
}

bool find_doubtful(const ShrinkingSet& set, DoubtfulPixels& pixels, int share) {
  if (!find_not_plain(set, pixels, share)) return false;
  spread(pixels, static_cast<std::size_t>(set.words_per_row()));
  return true;
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(find_doubtful);

void remove_sure(ShrinkingSet& set, DoubtfulPixels& room, int share) {
  if (!HWY_DYNAMIC_DISPATCH(find_doubtful)(set, room, share)) return;
  for (std::size_t i = 0; i < room.bits.size(); ++i) {
    std::uint64_t& word = set.words()[i];
    const std::uint64_t sure = word >> 32 & ~room.bits[i];
    word &= ~(sure | sure << 32);
  }
}

}  // namespace marrow
#endif
