// One triangle on the lattice of an image, and its exact fill: what every kernel does for the
// triangles that it has no short way for, and what the tests hold the kernels against.
#pragma once

#include <marrow/silhouette.hpp>

#include <algorithm>
#include <array>

namespace marrow {

/// log2 of the lattice steps to a pixel.
int lattice_shift(int resolution);

/// Half plane a * x + c >= 0 along one row; x in pixels.
struct EdgeOnRow {
  std::int64_t a = 0, c = 0;
};

/// A triangle on the lattice and the box of the pixel centres that it may hold; left > right or
/// low > high where it can hold none.
class LatticeTriangle {
 public:
  LatticeTriangle(const SnappedPoints& p, const Triangle& t, int shift) {
    for (std::size_t i = 0; i < 3; ++i) x_[i] = p.x(t[i]), y_[i] = p.y(t[i]);
    const int round_up = (1 << shift) - 1;
    left = (std::min({x_[0], x_[1], x_[2]}) + round_up) >> shift;
    right = std::max({x_[0], x_[1], x_[2]}) >> shift;
    low = (std::min({y_[0], y_[1], y_[2]}) + round_up) >> shift;
    high = std::max({y_[0], y_[1], y_[2]}) >> shift;
  }

  bool misses_all_centres() const { return left > right || low > high; }

  std::int64_t twice_area() const {
    return std::int64_t{x_[1] - x_[0]} * (y_[2] - y_[0]) -
           std::int64_t{x_[2] - x_[0]} * (y_[1] - y_[0]);
  }

  /// Makes it counter-clockwise.
  void orient() {
    if (twice_area() < 0) std::swap(x_[1], x_[2]), std::swap(y_[1], y_[2]);
  }

  /// The edge functions on pixel row `row`; inside is where none is negative, if it is
  /// counter-clockwise.
  std::array<EdgeOnRow, 3> edges_on_row(int row, int shift) const {
    std::array<EdgeOnRow, 3> e;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::int64_t dx = x_[j] - x_[i], dy = y_[j] - y_[i];
      // dx * (Y - y) - dy * (X - x) >= 0
      e[i].a = -dy * (1 << shift);
      e[i].c = dx * ((std::int64_t{row} << shift) - y_[i]) + dy * x_[i];
    }
    return e;
  }

  int left, right, low, high;

 private:
  std::array<int, 3> x_, y_;
};

/// Sets the pixels whose centres lie in a counter-clockwise triangle or on its edge.
void fill_exactly(BitImage& mask, const LatticeTriangle& triangle, int shift);

}  // namespace marrow
