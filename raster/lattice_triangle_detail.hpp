// One triangle on the lattice of an image.
#pragma once

#include <marrow/silhouette.hpp>

#include <algorithm>
#include <array>

namespace marrow {

/// log2 of the lattice steps to a pixel.
int lattice_shift(int resolution);

/// The pixel of a lattice coordinate.
inline int nearest_pixel(int coordinate, int shift) {
  return (coordinate + (1 << shift) / 2) >> shift;
}

/// Triangles by the places of their corners, packed as in SnappedPoints.
struct PackedTriangles {
  std::vector<SnappedPoints::Packed> a, b, c;

  std::size_t size() const { return a.size(); }
  void push_back(const SnappedPoints& points, const Triangle& t) {
    a.push_back(points.packed()[t[0]]);
    b.push_back(points.packed()[t[1]]);
    c.push_back(points.packed()[t[2]]);
  }
};

struct LatticePoint {
  int x, y;
};

inline LatticePoint unpacked(SnappedPoints::Packed p) {
  return {static_cast<int>(p & 0xffff), static_cast<int>(p >> 16)};
}

inline std::array<LatticePoint, 3> corners_of(const PackedTriangles& triangles, std::size_t i) {
  return {unpacked(triangles.a[i]), unpacked(triangles.b[i]), unpacked(triangles.c[i])};
}

inline std::array<LatticePoint, 3> corners_of(const SnappedPoints& points, const Triangle& t) {
  const SnappedPoints::Packed* const packed = points.packed();
  return {unpacked(packed[t[0]]), unpacked(packed[t[1]]), unpacked(packed[t[2]])};
}

/// Negative when they run clockwise.
inline std::int64_t twice_area(const std::array<LatticePoint, 3>& p) {
  return std::int64_t{p[1].x - p[0].x} * (p[2].y - p[0].y) -
         std::int64_t{p[2].x - p[0].x} * (p[1].y - p[0].y);
}

/// Half plane a * x + c >= 0 along one row; x in pixels.
struct EdgeOnRow {
  std::int64_t a = 0, c = 0;
};

/// A triangle on the lattice and the box of the pixel centres that it may hold; left > right or
/// low > high where it can hold none.
class LatticeTriangle {
 public:
  LatticeTriangle(const std::array<LatticePoint, 3>& corners, int shift) : p_(corners) {
    const int x0 = std::min(std::min(p_[0].x, p_[1].x), p_[2].x);
    const int y0 = std::min(std::min(p_[0].y, p_[1].y), p_[2].y);
    const int x1 = std::max(std::max(p_[0].x, p_[1].x), p_[2].x);
    const int y1 = std::max(std::max(p_[0].y, p_[1].y), p_[2].y);
    const int round_up = (1 << shift) - 1;
    left = (x0 + round_up) >> shift, right = x1 >> shift;
    low = (y0 + round_up) >> shift, high = y1 >> shift;
  }

  bool misses_all_centres() const { return left > right || low > high; }
  /// Three pixel centres or more along a side, may be none along the other.
  bool is_large() const { return right - left > 1 || high - low > 1; }

  /// The edge functions on pixel row `row`; inside is where none is negative, if it is
  /// counter-clockwise.
  std::array<EdgeOnRow, 3> edges_on_row(int row, int shift) const {
    std::array<EdgeOnRow, 3> e;
    for (std::size_t i = 0; i < 3; ++i) {
      const LatticePoint &p = p_[i], &q = p_[(i + 1) % 3];
      const std::int64_t dx = q.x - p.x, dy = q.y - p.y;
      // dx * (Y - y) - dy * (X - x) >= 0
      e[i].a = -dy * (1 << shift);
      e[i].c = dx * ((std::int64_t{row} << shift) - p.y) + dy * p.x;
    }
    return e;
  }

  int left, right, low, high;

 private:
  std::array<LatticePoint, 3> p_;
};

}  // namespace marrow
