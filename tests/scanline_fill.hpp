// The plain way to a silhouette, one triangle, row and step at a time: what the kernels for many at
// a time are held against. (silhouette_test.cpp holds both against the definition.)
#pragma once

#include <marrow/silhouette.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace marrow::test {

struct ScanTriangle {
  std::array<int, 3> x, y;
  int left, right, low, high;  // pixel centres; left > right or low > high where there is none

  ScanTriangle(const SnappedPoints& points, const Triangle& t, int steps) {
    for (std::size_t i = 0; i < 3; ++i) x[i] = points.x(t[i]), y[i] = points.y(t[i]);
    left = (std::min({x[0], x[1], x[2]}) + steps - 1) / steps;
    right = std::max({x[0], x[1], x[2]}) / steps;
    low = (std::min({y[0], y[1], y[2]}) + steps - 1) / steps;
    high = std::max({y[0], y[1], y[2]}) / steps;
  }

  std::int64_t twice_area() const {
    return std::int64_t{x[1] - x[0]} * (y[2] - y[0]) - std::int64_t{x[2] - x[0]} * (y[1] - y[0]);
  }
};

inline std::int64_t floor_of(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

inline void scan_row(BitImage& mask, const ScanTriangle& t, int row, int steps) {
  std::int64_t left = t.left, right = t.right;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::int64_t dx = t.x[j] - t.x[i], dy = t.y[j] - t.y[i];
    // dx * (Y - y) - dy * (X - x) = c + a * column, not negative inside
    const std::int64_t a = -dy * steps;
    const std::int64_t c = dx * (std::int64_t{row} * steps - t.y[i]) + dy * t.x[i];
    if (a > 0)
      left = std::max(left, -floor_of(c, a));
    else if (a < 0)
      right = std::min(right, floor_of(c, -a));
    else if (c < 0)
      return;
  }
  for (std::int64_t column = left; column <= right; ++column)
    mask.set(static_cast<int>(column), row);
}

/// What fill_triangles() must give.
inline BitImage scanline_fill(const SnappedPoints& points, const std::vector<Triangle>& triangles,
                              int resolution) {
  const int steps = subpixels_of(resolution);
  BitImage mask(resolution, resolution);
  for (const Triangle& corners : triangles) {
    ScanTriangle t(points, corners, steps);
    if (t.twice_area() < 0) std::swap(t.x[1], t.x[2]), std::swap(t.y[1], t.y[2]);
    for (int row = t.low; row <= t.high; ++row) scan_row(mask, t, row, steps);
  }
  return mask;
}

/// The pixels along an edge that `near_mask` does not hold.
inline void step_along(BitImage& trace, const BitImage& near_mask, std::array<int, 2> p,
                       std::array<int, 2> q, int steps) {
  if (q < p) std::swap(p, q);
  const int count = std::max(q[0] - p[0], std::abs(q[1] - p[1])) / steps + 1;
  for (int i = 0; i <= count; ++i) {
    const int x = (p[0] + (q[0] - p[0]) * i / count + steps / 2) / steps;
    const int y = (p[1] + (q[1] - p[1]) * i / count + steps / 2) / steps;
    if (!near_mask(x, y)) trace.set(x, y);
  }
}

/// What trace_thin_triangles() must make of `mask`.
inline BitImage step_trace(const BitImage& mask, const SnappedPoints& points,
                           const std::vector<Triangle>& triangles, int resolution) {
  const int steps = subpixels_of(resolution);
  const BitImage near_mask = dilate(mask, 1.5);
  BitImage traced = mask;
  for (const Triangle& corners : triangles) {
    const ScanTriangle t(points, corners, steps);
    if (std::abs(t.twice_area()) >= std::int64_t{8} * steps * steps) continue;
    const bool is_small = t.right - t.left < 2 && t.high - t.low < 2;
    const auto is_near = [&](std::size_t i) {
      return near_mask((t.x[i] + steps / 2) / steps, (t.y[i] + steps / 2) / steps);
    };
    if (is_small && is_near(0) && is_near(1) && is_near(2)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      step_along(traced, near_mask, {t.x[i], t.y[i]}, {t.x[j], t.y[j]}, steps);
    }
  }
  return traced;
}

}  // namespace marrow::test
