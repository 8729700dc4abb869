#include <algorithm>

#include "thin_triangles_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "covered.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "packed_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whether the bits at these packed places are set, as one or zero.
HWY_INLINE U32 bits_at(const std::uint32_t* words, int stride, U32 places) {
  const D d;
  const U32 x = hn::And(places, hn::Set(d, 0xffff)), y = hn::ShiftRight<16>(places);
  const U32 at =
      hn::Add(hn::Mul(y, hn::Set(d, static_cast<std::uint32_t>(stride))), hn::ShiftRight<5>(x));
  const U32 word = hn::GatherIndex(d, words, hn::BitCast(Int(), at));
  return hn::And(hn::Shr(word, hn::And(x, hn::Set(d, 31))), hn::Set(d, 1));
}

/// The pixels next to packed places.
HWY_INLINE U32 nearest_pixels(U32 places, int shift) {
  return shift_both(hn::Add(places, in_both_halves(1u << shift >> 1)), shift);
}

/// There must be enough points for a vector; in the last one some are taken again.
bool holds_all_on_target(const std::uint32_t* words, int stride, const std::uint32_t* points,
                         std::size_t count, int shift) {
  const D d;
  U32 all = hn::Set(d, 1);
  for (std::size_t at = 0; at < count; at += hn::Lanes(d)) {
    const U32 p = hn::LoadU(d, points + std::min(at, count - hn::Lanes(d)));
    all = hn::And(all, bits_at(words, stride, nearest_pixels(p, shift)));
  }
  return hn::AllTrue(d, hn::Eq(all, hn::Set(d, 1)));
}

/// Whether the squares are there in all four corners of the boxes from `low` to `high`, as one or
/// zero. In a box smaller than a square they are one and the same.
HWY_INLINE U32 squares_at_corners(const std::uint32_t* words, int stride, int side, U32 low,
                                  U32 high) {
  const D d;
  const U32 own = in_both_halves(static_cast<std::uint32_t>(side) - 1);
  const U32 reach = hn::Sub(high, low);
  const U32 far = hn::Add(low, hn::Sub(reach, least({reach, own, own})));
  const U32 x = hn::Set(d, 0xffff), y = hn::Set(d, 0xffff0000);
  const U32 right = hn::Or(hn::And(far, x), hn::And(low, y));
  const U32 above = hn::Or(hn::And(low, x), hn::And(far, y));
  return hn::And(hn::And(bits_at(words, stride, low), bits_at(words, stride, far)),
                 hn::And(bits_at(words, stride, right), bits_at(words, stride, above)));
}

/// There must be enough triangles for a vector; in the last one some are taken again.
PackedTriangles not_within_on_target(const std::uint32_t* words, int stride, int side,
                                     const PackedTriangles& triangles, int shift) {
  const D d;
  PackedTriangles rest;
  for (auto* const corners : {&rest.a, &rest.b, &rest.c})
    corners->resize(triangles.size() + 2 * kSlack);
  const U32 too_far = in_both_halves(0x10000u - 2 * static_cast<std::uint32_t>(side));
  std::size_t size = 0;
  for (std::size_t at = 0; at < triangles.size(); at += hn::Lanes(d)) {
    const std::size_t i = std::min(at, triangles.size() - hn::Lanes(d));
    const Corners t = {hn::LoadU(d, &triangles.a[i]), hn::LoadU(d, &triangles.b[i]),
                       hn::LoadU(d, &triangles.c[i])};
    const U32 low = nearest_pixels(least(t), shift), high = nearest_pixels(greatest(t), shift);
    const U32 beyond = hn::And(hn::Sub(high, low), too_far);
    const U32 missing = hn::Sub(hn::Set(d, 1), squares_at_corners(words, stride, side, low, high));
    const Choice chosen(hn::Ne(hn::Or(beyond, missing), hn::Zero(d)));
    chosen.store(t.a, &rest.a[size]);
    chosen.store(t.b, &rest.b[size]);
    chosen.store(t.c, &rest.c[size]);
    size += chosen.size();
  }
  for (auto* const corners : {&rest.a, &rest.b, &rest.c}) corners->resize(size);
  return rest;
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(holds_all_on_target);
HWY_EXPORT(not_within_on_target);

namespace {

constexpr std::size_t kEnough = 64;  // for any vector

/// An image in words of 32 bits, lower half first.
std::vector<std::uint32_t> halves(const BitImage& image) {
  std::vector<std::uint32_t> result;
  for (const BitImage::Word word : image.words()) {
    result.push_back(static_cast<std::uint32_t>(word));
    result.push_back(static_cast<std::uint32_t>(word >> 32));
  }
  return result;
}

bool holds(const BitImage& image, SnappedPoints::Packed point, int shift) {
  const LatticePoint p = unpacked(point);
  return image(nearest_pixel(p.x, shift), nearest_pixel(p.y, shift));
}

}  // namespace

bool holds_all(const BitImage& image, const SnappedPoints& points, int shift) {
  const std::span all(points.packed(), points.size());
  if (all.size() < kEnough)
    return std::all_of(all.begin(), all.end(), [&](auto p) { return holds(image, p, shift); });
  return HWY_DYNAMIC_DISPATCH(holds_all_on_target)(halves(image).data(), 2 * image.words_per_row(),
                                                   all.data(), all.size(), shift);
}

PackedTriangles not_within(const BitImage& squares, int side, const PackedTriangles& triangles,
                           int shift) {
  if (triangles.size() < kEnough) return triangles;
  return HWY_DYNAMIC_DISPATCH(not_within_on_target)(
      halves(squares).data(), 2 * squares.words_per_row(), side, triangles, shift);
}

}  // namespace marrow
#endif
