// Sine, cosine and the angle of a vector from the four operations only: libm's last bits differ
// from one machine to the next, and a shape must come out with the same bytes everywhere. Angles
// are in turns: 1 is the full circle.
#pragma once

#include <cmath>
#include <numbers>

namespace marrow {

struct SinCos {
  double sin = 0, cos = 1;
};

/// Good to about 1e-15; exact at quarter turns.
inline SinCos sin_cos_of_turns(double turns) {
  const double quarters = std::floor(turns * 4 + 0.5);
  const double x = (turns - quarters / 4) * 2 * std::numbers::pi;  // in [-pi/4, pi/4]
  double s = 0;
  double c = 0;
  for (int i = 9; i >= 1; --i) {  // Taylor, from the smallest term
    s = (1 - s) * x * x / (2 * i * (2 * i + 1));
    c = (1 - c) * x * x / ((2 * i - 1) * 2 * i);
  }
  s = x * (1 - s);
  c = 1 - c;
  const int quadrant = static_cast<int>(quarters - 4 * std::floor(quarters / 4));
  switch (quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// The angle of (x, y) in (-1/2, 1/2]; 0 for the null vector.
inline double turns_of(double y, double x) {
  const double large = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
  const double small = std::abs(x) > std::abs(y) ? std::abs(y) : std::abs(x);
  if (large == 0) return 0;
  double turns = small / large / 8;
  for (int i = 0; i < 4; ++i) {  // tan of what is left, which shrinks with the third power
    const SinCos at = sin_cos_of_turns(turns);
    const double left = (small * at.cos - large * at.sin) / (large * at.cos + small * at.sin);
    turns += (left - left * left * left / 3) / (2 * std::numbers::pi);
  }
  if (std::abs(y) > std::abs(x)) turns = 0.25 - turns;
  if (x < 0) turns = 0.5 - turns;
  return y < 0 ? -turns : turns;
}

}  // namespace marrow
