// Tubes and balls of a few pixels, shaded and outlined, in front of the picture.
#pragma once

#include <marrow/vec.hpp>

#include <vector>

#include "picture/image.hpp"

namespace marrow {

/// A round stroke from `a` to `b` in pixels, z is nearness in pixels. A ball where a = b.
struct Stroke {
  Vec3 a, b;
  float radius = 1;                ///< pixels
  float outline = 1;               ///< pixels around it
  float value_a = 0, value_b = 0;  ///< place in the radius colour map at both ends, 0..1
  float haze_a = 0, haze_b = 0;    ///< part of the haze mixed in at both ends, 0..1: far is paler
  bool is_marked = false;          ///< `colour` instead of the map
  Colour colour;
};

/// What far strokes fade to on white paper.
inline constexpr Colour kPaleHaze = from_bytes(226, 233, 240);

/// Paints the strokes over what is there, nearer ones in front, smooth edges, inside `area`. The
/// order of the strokes only settles equal depths. The same pixels for any number of threads.
void draw_strokes(Canvas& canvas, const Rect& area, const std::vector<Stroke>& strokes,
                  const Colour& haze = kPaleHaze);

}  // namespace marrow
