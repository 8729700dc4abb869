// Thinning after Arcelli and Sanniti di Baja: "A width-independent fast thinning algorithm" and
// "Ridge points in Euclidean distance maps": pixels go in the order of their distance, centres of
// maximal discs stay.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include "thinning_detail.hpp"

namespace marrow {

namespace {

/// Simple points for every neighbourhood; bit k is neighbour k, counter-clockwise from the right.
constexpr std::array<bool, 256> simple_table() {
  std::array<bool, 256> table{};
  for (unsigned code = 0; code < 256; ++code) {
    const auto set = [code](unsigned k) { return (code >> (k % 8) & 1) != 0; };
    int crossings = 0;  // 8-connected pieces that touch the pixel across a gap of the background
    for (unsigned k = 0; k < 8; k += 2)
      if (!set(k) && (set(k + 1) || set(k + 2))) ++crossings;
    table[code] = crossings == 1;
  }
  return table;
}

constexpr auto kSimple = simple_table();

/// Offsets of the eight neighbours in a row-major image, counter-clockwise from the right.
std::array<std::ptrdiff_t, 8> neighbour_offsets(int width) {
  const std::ptrdiff_t w = width;
  return {1, 1 - w, -w, -1 - w, -1, w - 1, w, w + 1};
}

unsigned neighbourhood(const std::uint8_t* p, const std::array<std::ptrdiff_t, 8>& offset) {
  unsigned code = 0;
  for (unsigned k = 0; k < 8; ++k) code |= static_cast<unsigned>(p[offset[k]]) << k;
  return code;
}

/// An end as wide as two pixels: two neighbours, side by side.
bool is_wide_end(unsigned code) {
  const unsigned turned = (code << 1 | code >> 7) & 0xff;
  return std::popcount(code) == 2 && (code & turned) != 0;
}

/// The least radius that gives the same disc: distances 3 and 6 stand for 1 and 5.
int label(ChamferDistance d) { return d == 3 ? 1 : d == 6 ? 5 : d; }

bool is_centre_of_maximal_disc(const ChamferDistance* d,
                               const std::array<std::ptrdiff_t, 8>& offset) {
  for (unsigned k = 0; k < 8; ++k)
    if (label(d[offset[k]]) >= label(*d) + (k % 2 == 0 ? 3 : 4)) return false;
  return true;
}

/// Pixels of the support of `map` by distance, then by index.
std::vector<std::uint32_t> by_distance(const DistanceMap& map) {
  const auto values = map.pixels();
  ChamferDistance greatest = 0;
  for (const auto d : values) greatest = std::max(greatest, d);
  std::vector<std::uint32_t> start(greatest + 2u, 0);
  for (const auto d : values) ++start[d + 1u];
  start[1] = 0;  // the background is left out
  for (std::size_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
  std::vector<std::uint32_t> order(start.back());
  for (std::uint32_t i = 0; i < values.size(); ++i)
    if (values[i] != 0) order[start[values[i]]++] = i;
  return order;
}

}  // namespace

PixelSet thin_to_medial_axis(const DistanceMap& map) {
  const int width = map.width(), height = map.height();
  PixelSet set(width, height, 0);
  const auto offset = neighbour_offsets(width);
  const auto distance = map.pixels();
  auto pixels = set.pixels();
  enum : std::uint8_t { kPlain = 0, kAnchor = 1 };
  std::vector<std::uint8_t> kind(pixels.size(), kPlain);
  const auto order = by_distance(map);
  for (const auto i : order) {
    pixels[i] = 1;
    kind[i] = is_centre_of_maximal_disc(&distance[i], offset) ? kAnchor : kPlain;
  }

  std::vector<std::uint32_t> again;
  const auto remove_if_simple = [&](std::uint32_t i) {
    if (!pixels[i] || kind[i] == kAnchor || !kSimple[neighbourhood(&pixels[i], offset)]) return;
    pixels[i] = 0;
    // What was kept before may be simple now; what comes later has its turn anyway.
    for (const auto o : offset) {
      const auto n = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + o);
      if (pixels[n] && kind[n] == kPlain && distance[n] <= distance[i]) again.push_back(n);
    }
  };
  for (const auto i : order) {
    remove_if_simple(i);
    while (!again.empty()) {
      const auto n = again.back();
      again.pop_back();
      remove_if_simple(n);
    }
  }

  // Anchors lie two wide on even-width parts.
  thin_to_unit_width(set, order);
  return set;
}

void thin_to_unit_width(PixelSet& set, std::span<const std::uint32_t> order) {
  const auto offset = neighbour_offsets(set.width());
  auto pixels = set.pixels();
  // Wide ends come last, or from them on a part two wide would be eaten up.
  for (const bool wide_ends_too : {false, true})
    for (const auto i : order) {
      if (!pixels[i]) continue;
      const unsigned code = neighbourhood(&pixels[i], offset);
      if (!kSimple[code] || std::popcount(code) <= 1) continue;
      if (wide_ends_too || !is_wide_end(code)) pixels[i] = 0;
    }
}

}  // namespace marrow
