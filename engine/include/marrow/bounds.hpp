// The box around points.
#pragma once

#include <marrow/vec.hpp>

#include <algorithm>

namespace marrow {

struct Bounds {
  Vec3 low, high;
  bool is_empty = true;

  void add(const Vec3& p) {
    if (is_empty) low = high = p;
    is_empty = false;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }

  Vec3 center() const { return (low + high) * 0.5; }
  double longest_side() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
  /// Scaled first, so that no square overflows or vanishes.
  double diagonal() const {
    const double longest = longest_side();
    return longest > 0 ? longest * length((high - low) / longest) : 0;
  }
};

}  // namespace marrow
