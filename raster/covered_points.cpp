#include "thin_triangles_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "covered_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whether the pixels of the points from `i` on are set, as many at a time as `d` has lanes;
/// `i` moves to where it ended. A row is `stride` words.
template <class D>
bool holds_points(D d, const std::uint32_t* words, int stride, const SnappedPoints& points,
                  int shift, std::size_t& i) {
  const hn::RebindToSigned<D> di;
  const std::size_t lanes = hn::Lanes(d);
  const auto half = hn::Set(d, 1u << shift >> 1), one = hn::Set(d, 1);
  const auto row_words = hn::Set(d, static_cast<std::uint32_t>(stride));
  auto all = one;
  for (; i + lanes <= points.size(); i += lanes) {
    const auto p = hn::LoadU(d, points.packed() + i);
    const auto x = hn::ShiftRightSame(hn::Add(hn::And(p, hn::Set(d, 0xffff)), half), shift);
    const auto y = hn::ShiftRightSame(hn::Add(hn::ShiftRight<16>(p), half), shift);
    const auto at = hn::Add(hn::Mul(y, row_words), hn::ShiftRight<5>(x));
    const auto word = hn::GatherIndex(d, words, hn::BitCast(di, at));
    all = hn::And(all, hn::Shr(word, hn::And(x, hn::Set(d, 31))));
  }
  return hn::AllTrue(d, hn::Eq(all, one));
}

bool holds_all_on_target(const std::uint32_t* words, int stride, const SnappedPoints& points,
                         int shift) {
  std::size_t i = 0;
  return holds_points(hn::ScalableTag<std::uint32_t>(), words, stride, points, shift, i) &&
         holds_points(hn::CappedTag<std::uint32_t, 1>(), words, stride, points, shift, i);
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(holds_all_on_target);

bool holds_all(const BitImage& image, const SnappedPoints& points, int shift) {
  std::vector<std::uint32_t> halves;
  for (const BitImage::Word word : image.words()) {
    halves.push_back(static_cast<std::uint32_t>(word));
    halves.push_back(static_cast<std::uint32_t>(word >> 32));
  }
  return HWY_DYNAMIC_DISPATCH(holds_all_on_target)(halves.data(), 2 * image.words_per_row(), points,
                                                   shift);
}

}  // namespace marrow
#endif
