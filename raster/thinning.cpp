// Thinning after Arcelli and Sanniti di Baja: "A width-independent fast thinning algorithm" and
// "Ridge points in Euclidean distance maps": pixels go in the order of their distance, centres of
// maximal discs stay.
#include <algorithm>

#include "thinning_detail.hpp"

// No vectors here: the better instruction sets also have better ones for single bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "thinning.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

using Pixel = ShrinkingSet::Pixel;

constexpr unsigned kCentre = 1u << 4;
/// Bits of the neighbours in what is around a pixel, counter-clockwise from the right.
constexpr std::array<unsigned, 8> kRing{5, 2, 1, 0, 3, 6, 7, 8};

/// What is around a pixel as eight bits; bit k is neighbour k of the ring.
constexpr unsigned ring_of(unsigned around) {
  unsigned ring = 0;
  for (unsigned k = 0; k < 8; ++k) ring |= (around >> kRing[k] & 1) << k;
  return ring;
}

constexpr auto kRingOf = [] {
  std::array<std::uint8_t, 512> table{};
  for (unsigned around = 0; around < table.size(); ++around)
    table[around] = static_cast<std::uint8_t>(ring_of(around));
  return table;
}();

/// A pixel that can go without a change of topology: one 8-connected piece around it touches it
/// across a gap of the background.
constexpr bool is_simple(unsigned ring) {
  const auto set = [ring](unsigned k) { return (ring >> (k % 8) & 1) != 0; };
  int crossings = 0;
  for (unsigned k = 0; k < 8; k += 2)
    if (!set(k) && (set(k + 1) || set(k + 2))) ++crossings;
  return crossings == 1;
}

/// An end as wide as two pixels: two neighbours, side by side.
constexpr bool is_wide_end(unsigned ring) {
  const unsigned turned = (ring << 1 | ring >> 7) & 0xff;
  return std::popcount(ring) == 2 && (ring & turned) != 0;
}

constexpr unsigned kSimple = 1, kNoEnd = 2, kNoWideEnd = 4;

/// Properties of a pixel by what is around it.
constexpr auto kProperties = [] {
  std::array<std::uint8_t, 512> table{};
  for (unsigned around = 0; around < table.size(); ++around) {
    const unsigned ring = kRingOf[around];
    table[around] = static_cast<std::uint8_t>((is_simple(ring) ? kSimple : 0u) |
                                              (std::popcount(ring) > 1 ? kNoEnd : 0u) |
                                              (is_wide_end(ring) ? 0u : kNoWideEnd));
  }
  return table;
}();

enum class Which { Loose, All };

/// Pixels by distance, then by number.
template <Which kWhich>
std::span<const Pixel> by_distance(const ShrinkingSet& set, PixelOrder& order) {
  const auto bits_of_word = [&](std::size_t i) {
    return kWhich == Which::Loose ? set.loose_in_word(i) : set.in_word(i);
  };
  const auto pixel = [](std::size_t i, std::uint32_t bits) {
    return static_cast<Pixel>(32 * i) + static_cast<Pixel>(std::countr_zero(bits));
  };
  std::vector<std::uint32_t>& start = order.start;
  start.assign(set.greatest_distance() + 2u, 0);
  for (std::size_t i = 0; i < set.word_count(); ++i)
    for (auto bits = bits_of_word(i); bits != 0; bits &= bits - 1)
      ++start[set.distance(pixel(i, bits)) + 1u];
  for (std::size_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
  order.pixels.resize(start.back());
  for (std::size_t i = 0; i < set.word_count(); ++i)
    for (auto bits = bits_of_word(i); bits != 0; bits &= bits - 1) {
      const Pixel p = pixel(i, bits);
      order.pixels[start[set.distance(p)]++] = p;
    }
  return order.pixels;
}

/// Removes `p` if it is loose and simple, and then what was kept before and is simple now; what
/// comes later has its turn anyway. `waiting` is empty before and after.
HWY_INLINE void peel(ShrinkingSet& set, Pixel p, std::vector<Pixel>& waiting) {
  for (;;) {
    const std::uint64_t around = set.around(p);
    const auto loose = static_cast<unsigned>(around >> 32);
    unsigned again = 0;
    if ((loose / kCentre & kProperties[around & 0x1ff] & kSimple) != 0) {
      set.remove(p);
      again = loose & set.not_deeper(p);
    }
    if (again != 0 && (again & (again - 1)) == 0) {  // mostly one
      p = set.neighbour(p, static_cast<unsigned>(std::countr_zero(again)));
      continue;
    }
    for (unsigned ring = kRingOf[again]; ring != 0; ring &= ring - 1)
      waiting.push_back(set.neighbour(p, kRing[static_cast<std::size_t>(std::countr_zero(ring))]));
    if (waiting.empty()) return;
    p = waiting.back();
    waiting.pop_back();
  }
}

void to_unit_width(ShrinkingSet& set, std::span<const Pixel> order) {
  // Wide ends come last, or from them on a part two wide would be eaten up.
  for (const unsigned wanted : {kSimple | kNoEnd | kNoWideEnd, kSimple | kNoEnd})
    for (const auto p : order)
      if (set.contains(p) && (kProperties[set.around(p) & 0x1ff] & wanted) == wanted) set.remove(p);
}

void to_medial_axis(ShrinkingSet& set, PixelOrder& order) {
  std::vector<Pixel> waiting;
  for (const auto p : by_distance<Which::Loose>(set, order))
    if (set.contains(p)) peel(set, p, waiting);
  // Centres lie two wide on even-width parts.
  to_unit_width(set, by_distance<Which::All>(set, order));
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(to_medial_axis);
HWY_EXPORT(to_unit_width);

void thin_to_medial_axis(ShrinkingSet& set, PixelOrder& order) {
  HWY_DYNAMIC_DISPATCH(to_medial_axis)(set, order);
}

void thin_to_unit_width(ShrinkingSet& set, std::span<const ShrinkingSet::Pixel> order) {
  HWY_DYNAMIC_DISPATCH(to_unit_width)(set, order);
}

}  // namespace marrow
#endif
