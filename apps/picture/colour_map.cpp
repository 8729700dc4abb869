#include "picture/colour_map.hpp"

#include <array>

namespace marrow {
namespace {

/// Piecewise linear through evenly spaced colours.
template <std::size_t N>
Colour along(const std::array<Colour, N>& stops, float t) {
  const float place = std::clamp(t, 0.0F, 1.0F) * static_cast<float>(N - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), N - 2);
  return mix(stops[i], stops[i + 1], place - static_cast<float>(i));
}

constexpr std::array<Colour, 6> kRadius = {from_bytes(253, 200, 66), from_bytes(248, 149, 64),
                                           from_bytes(225, 94, 92),  from_bytes(182, 48, 125),
                                           from_bytes(122, 20, 138), from_bytes(54, 12, 115)};

constexpr std::array<Colour, 6> kHeat = {from_bytes(0, 0, 4),      from_bytes(62, 12, 102),
                                         from_bytes(142, 33, 101), from_bytes(215, 68, 62),
                                         from_bytes(250, 155, 30), from_bytes(252, 250, 180)};

/// Around the circle of hues, about equally light.
constexpr std::array<Colour, 9> kHues = {
    from_bytes(226, 83, 90),   from_bytes(221, 122, 38), from_bytes(186, 151, 22),
    from_bytes(104, 172, 56),  from_bytes(20, 168, 132), from_bytes(24, 155, 205),
    from_bytes(104, 124, 232), from_bytes(196, 86, 196), from_bytes(226, 83, 90)};

}  // namespace

Colour radius_colour(float t) { return along(kRadius, t); }
Colour heat_colour(float t) { return along(kHeat, t); }

Colour branch_colour(std::uint32_t branch) {
  // Steps of the golden ratio of 2^32: no number of steps comes near a whole turn.
  const std::uint32_t turn = branch * 2654435769U + 2500000000U;
  return along(kHues, static_cast<float>(turn >> 8) / 16777216.0F);
}

}  // namespace marrow
