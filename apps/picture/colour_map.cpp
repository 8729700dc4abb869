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

}  // namespace

Colour radius_colour(float t) { return along(kRadius, t); }
Colour heat_colour(float t) { return along(kHeat, t); }

}  // namespace marrow
