#include <cmath>

#include "lattice_triangle_detail.hpp"

namespace marrow {

namespace {

void set_span(BitImage::Word* row, int left, int right) {
  const int first = left >> 6, last = right >> 6;
  const BitImage::Word from = ~BitImage::Word{0} << (left & 63);
  const BitImage::Word to = ~BitImage::Word{0} >> (63 - (right & 63));
  if (first == last) {
    row[first] |= from & to;
    return;
  }
  row[first] |= from;
  for (int i = first + 1; i < last; ++i) row[i] = ~BitImage::Word{0};
  row[last] |= to;
}

/// Floor of c / d; exact in double because both are integers far below 2^53 and d < 2^24.
int floor_div(std::int64_t c, std::int64_t d) {
  return static_cast<int>(std::floor(static_cast<double>(c) / static_cast<double>(d)));
}

void fill_row(BitImage& mask, const LatticeTriangle& t, int y, int shift) {
  int left = t.left, right = t.right;
  for (const auto& e : t.edges_on_row(y, shift)) {
    if (e.a > 0)
      left = std::max(left, -floor_div(e.c, e.a));
    else if (e.a < 0)
      right = std::min(right, floor_div(e.c, -e.a));
    else if (e.c < 0)
      return;
  }
  if (left <= right) set_span(mask.row(y), left, right);
}

}  // namespace

void fill_exactly(BitImage& mask, const LatticeTriangle& t, int shift) {
  for (int y = t.low; y <= t.high; ++y) fill_row(mask, t, y, shift);
}

}  // namespace marrow
