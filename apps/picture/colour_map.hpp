// Colour maps whose lightness goes one way, so that more looks like more, in grey too.
#pragma once

#include <cstdint>

#include "picture/image.hpp"

namespace marrow {

/// For radii on white paper: light amber (thin) to dark violet (thick). `t` in 0..1, clamped.
Colour radius_colour(float t);

/// For amounts on a black ground: black, violet, red, orange, pale yellow. `t` in 0..1, clamped.
Colour heat_colour(float t);

/// For branches by their numbers: hues as far apart as they come, the first ones most of all, of
/// one lightness that stands out from white paper and from black.
Colour branch_colour(std::uint32_t branch);

}  // namespace marrow
