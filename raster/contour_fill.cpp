// Where a contour crosses a row of pixel centres the number of turns around them changes by one;
// the sum of all changes from the left is that number. Rows are crossed from their lower side on,
// so that a corner on a row counts once. A pixel centre on a contour is set by itself: which side
// of it the sum takes it for is nothing.
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "contour_fill_detail.hpp"
#include "mask_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contour_fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Sums up the changes along a row of whole words; a bit for every sum that is not zero.
template <class Turns>
void sum_row(const Turns* changes, BitImage::Word* row, int words) {
  const hn::CappedTag<Turns, 16 / sizeof(Turns)> d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));
  auto sum = hn::Zero(d);
  for (int i = 0; i < words; ++i) {
    const Turns* const at = changes + 64 * i;
    auto any = hn::LoadU(d, at);
    for (int k = kLanes; k < 64; k += kLanes) any = hn::Or(any, hn::LoadU(d, at + k));
    if (hn::AllTrue(d, hn::Eq(any, hn::Zero(d)))) {  // most words
      row[i] = hn::AllTrue(d, hn::Eq(sum, hn::Zero(d))) ? 0 : ~BitImage::Word{0};
      continue;
    }
    BitImage::Word bits = 0;
    for (int k = 0; k < 64; k += kLanes) {
      auto v = hn::LoadU(d, at + k);
#if HWY_TARGET != HWY_SCALAR
      v = hn::Add(v, hn::ShiftLeftLanes<1>(v));
      v = hn::Add(v, hn::ShiftLeftLanes<2>(v));
      if constexpr (kLanes > 4) v = hn::Add(v, hn::ShiftLeftLanes<4>(v));
#endif
      v = hn::Add(v, sum);
      sum = hn::Broadcast<kLanes - 1>(v);
      std::uint8_t some[8] = {};
      hn::StoreMaskBits(d, hn::Ne(v, hn::Zero(d)), some);
      bits |= BitImage::Word{some[0]} << k;
    }
    row[i] = bits;
  }
}

void sum_rows_16(const std::int16_t* changes, BitImage::Word* row, int words) {
  sum_row(changes, row, words);
}
void sum_rows_32(const std::int32_t* changes, BitImage::Word* row, int words) {
  sum_row(changes, row, words);
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(sum_rows_16);
HWY_EXPORT(sum_rows_32);

namespace {

void sum_row(const std::int16_t* changes, BitImage::Word* row, int words) {
  HWY_DYNAMIC_DISPATCH(sum_rows_16)(changes, row, words);
}
void sum_row(const std::int32_t* changes, BitImage::Word* row, int words) {
  HWY_DYNAMIC_DISPATCH(sum_rows_32)(changes, row, words);
}

/// `Turns` must hold as many turns as there are contours.
template <class Turns>
class ContourFill {
 public:
  explicit ContourFill(int resolution)
      : shift_(lattice_shift(resolution)),
        on_contours_(resolution, resolution),
        changes_(64 * on_contours_.words_per_row(), resolution) {}

  void add(const ContourEdge& edge) {
    auto [low, high] = edge;
    if (((high.x | high.y) & own_bits()) == 0) on_contours_.set(high.x >> shift_, high.y >> shift_);
    if (low.y == high.y) return add_level(low, high);
    Turns change = -1;
    if (low.y > high.y) std::swap(low, high), change = 1;
    const int first = pixel_from(low.y), end = pixel_from(high.y);
    if (first >= end) return;
    first_row_ = std::min(first_row_, first), end_row_ = std::max(end_row_, end);
    const std::int64_t dx = high.x - low.x, dy = high.y - low.y;
    // On a row the edge lies at `along` / `unit` pixels.
    const std::int64_t unit = dy << shift_, step = dx << shift_;
    std::int64_t along = low.x * dy + ((std::int64_t{first} << shift_) - low.y) * dx;
    // The floor of an integer and a half over `unit` is far enough from integers for a rounded
    // reciprocal.
    const double reciprocal = 1 / static_cast<double>(unit);
    for (int y = first; y < end; ++y, along += step) {
      const auto before =
          static_cast<std::int64_t>((static_cast<double>(along) - 0.5) * reciprocal + 1);
      const auto x = static_cast<int>(before);
      changes_(x, y) = static_cast<Turns>(changes_(x, y) + change);
      if (x * unit == along) on_contours_.set(x, y);
    }
  }

  BitImage result() && {
    BitImage filled(on_contours_.width(), on_contours_.height());
    for (int y = first_row_; y < end_row_; ++y)
      sum_row(changes_.row(y), filled.row(y), filled.words_per_row());
    return united(std::move(filled), on_contours_);
  }

 private:
  int own_bits() const { return (1 << shift_) - 1; }
  /// The first pixel from a lattice coordinate on.
  int pixel_from(int coordinate) const { return (coordinate + own_bits()) >> shift_; }

  void add_level(const LatticePoint& a, const LatticePoint& b) {
    if ((a.y & own_bits()) != 0) return;
    const int left = pixel_from(std::min(a.x, b.x)), right = std::max(a.x, b.x) >> shift_;
    if (left <= right) set_span(on_contours_.row(a.y >> shift_), left, right);
  }

  int shift_;
  BitImage on_contours_;
  Image<Turns> changes_;
  int first_row_ = std::numeric_limits<int>::max(), end_row_ = 0;
};

template <class Turns>
BitImage fill_with(std::span<const ContourEdge> contours, int resolution) {
  ContourFill<Turns> fill(resolution);
  for (const ContourEdge& edge : contours) fill.add(edge);
  return std::move(fill).result();
}

}  // namespace

BitImage fill_contours(std::span<const ContourEdge> contours, int resolution) {
  return contours.size() <= std::size_t{std::numeric_limits<std::int16_t>::max()}
             ? fill_with<std::int16_t>(contours, resolution)
             : fill_with<std::int32_t>(contours, resolution);
}

}  // namespace marrow
#endif
