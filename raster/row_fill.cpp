#include <bit>

#include "fill_detail.hpp"
#include "mask_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "row_fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;  // a row in each lane
using F64 = hn::Vec<D>;

/// Where an edge ends the rows of a triangle: at -bound() from the left, or at bound() from the
/// right. The floor of c / a for integers is that of (c + 1/2) / a, which lies so far from any
/// integer (half an a-th at least, while c < 2^32) that a rounded reciprocal will do.
class RowEnds {
 public:
  RowEnds(const EdgeOnRow& first, const EdgeOnRow& second) : is_left_(first.a > 0) {
    const D d;
    // A level edge bounds no row of the triangle's box.
    const auto a = static_cast<double>(first.a == 0 ? 1 : std::abs(first.a));
    const auto c = static_cast<double>(first.a == 0 ? std::int64_t{1} << 31 : first.c);
    const auto step = static_cast<double>(first.a == 0 ? 0 : second.c - first.c);
    reciprocal_ = hn::Set(d, 1 / a);
    value_ = hn::Add(hn::Set(d, c + 0.5), hn::Mul(hn::Iota(d, 0), hn::Set(d, step)));
    step_ = hn::Set(d, step * static_cast<double>(hn::Lanes(d)));
  }

  /// Narrows the rows in hand, and goes on to the next.
  void narrow(F64& left, F64& right) {
    const F64 bound = hn::Floor(hn::Mul(value_, reciprocal_));
    value_ = hn::Add(value_, step_);
    if (is_left_)
      left = hn::Max(left, hn::Neg(bound));
    else
      right = hn::Min(right, bound);
  }

 private:
  bool is_left_;
  F64 reciprocal_, value_, step_;
};

void fill_triangle(BitImage& mask, const LatticeTriangle& t, int shift) {
  const D d;
  const hn::Rebind<std::int32_t, D> columns;
  constexpr std::size_t kMostRows = hn::MaxLanes(D());
  const auto first = t.edges_on_row(t.low, shift), second = t.edges_on_row(t.low + 1, shift);
  RowEnds ab(first[0], second[0]), bc(first[1], second[1]), ca(first[2], second[2]);
  const int rows = static_cast<int>(hn::Lanes(d));
  for (int y = t.low; y <= t.high; y += rows) {
    F64 left = hn::Set(d, t.left), right = hn::Set(d, t.right);
    ab.narrow(left, right), bc.narrow(left, right), ca.narrow(left, right);
    const auto is_there = hn::FirstN(d, static_cast<std::size_t>(t.high - y + 1));
    const auto is_filled = hn::And(is_there, hn::Le(left, right));
    if (hn::AllFalse(d, is_filled)) continue;
    std::int32_t from[kMostRows], to[kMostRows];
    std::uint8_t filled[(kMostRows + 7) / 8 + 8];
    hn::StoreU(hn::DemoteTo(columns, left), columns, from);
    hn::StoreU(hn::DemoteTo(columns, right), columns, to);
    hn::StoreMaskBits(d, is_filled, filled);
    for (std::size_t byte = 0; 8 * byte < hn::Lanes(d); ++byte)
      for (unsigned bits = filled[byte]; bits != 0; bits &= bits - 1) {
        const std::size_t k = 8 * byte + static_cast<std::size_t>(std::countr_zero(bits));
        set_span(mask.row(y + static_cast<int>(k)), from[k], to[k]);
      }
  }
}

void fill_large_on_target(BitImage& mask, const PackedTriangles& triangles, Facing facing,
                          int shift) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto corners = corners_of(triangles, i);
    if (twice_area(corners) < 0) {
      if (facing == Facing::CounterClockwise) continue;
      std::swap(corners[1], corners[2]);
    }
    const LatticeTriangle t(corners, shift);
    if (t.misses_all_centres()) continue;
    fill_triangle(mask, t, shift);
  }
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(fill_large_on_target);

void fill_large(BitImage& mask, const PackedTriangles& triangles, Facing facing, int shift) {
  HWY_DYNAMIC_DISPATCH(fill_large_on_target)(mask, triangles, facing, shift);
}

}  // namespace marrow
#endif
