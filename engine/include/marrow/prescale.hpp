// A scale at which no product of coordinates overflows.
#pragma once

#include <marrow/bounds.hpp>

#include <algorithm>
#include <cmath>

namespace marrow {

/// A power of two that brings the largest coordinate near 1.
inline double prescale_of(const Bounds& box) {
  double largest = 0;
  for (const Vec3& p : {box.low, box.high})
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (largest == 0) return 1;
  return std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1020, 1020));
}

}  // namespace marrow
