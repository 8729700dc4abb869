#include <algorithm>
#include <bit>
#include <cstring>

#include "shrinking_set_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shrinking_set.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "mask_bits_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::int16_t, 32>;
using Distances = hn::Vec<Tag>;

/// What the eight neighbours of some pixels say: the greatest distances, and which are deeper.
struct Neighbours {
  explicit Neighbours(Distances d)
      : centre(d), beside(hn::Zero(Tag())), diagonal(beside), deeper(beside) {}

  HWY_INLINE void look(const std::int16_t* at, int bit) {
    const Tag d;
    const Distances v = hn::LoadU(d, at);
    Distances& greatest = bit % 2 == 0 ? diagonal : beside;
    greatest = hn::Max(greatest, v);
    const Distances flag = hn::Set(d, static_cast<std::int16_t>(1 << bit));
    deeper = hn::Or(deeper, hn::IfThenElseZero(hn::Gt(v, centre), flag));
  }

  Distances centre, beside, diagonal, deeper;
};

/// The least radius that gives the same disc: distances 3 and 6 stand for 1 and 5.
HWY_INLINE Distances label(Distances v) {
  const Tag d;
  const Distances three = hn::Set(d, 3), two = hn::Set(d, 2);
  const Distances six = hn::Set(d, 6), one = hn::Set(d, 1);
  return hn::Sub(hn::Sub(v, hn::IfThenElseZero(hn::Eq(v, three), two)),
                 hn::IfThenElseZero(hn::Eq(v, six), one));
}

/// The word of 32 pixels from `distance` on, rows being `stride` apart; their neighbours that are
/// not deeper go to `not_deeper`.
HWY_INLINE std::uint64_t classify(const std::int16_t* distance, std::ptrdiff_t stride,
                                  std::uint16_t* not_deeper) {
  const Tag d;
  const hn::RebindToUnsigned<Tag> du;
  std::uint64_t set = 0, centres = 0;
  for (std::size_t i = 0; i < 32; i += hn::Lanes(d)) {
    const std::int16_t* at = distance + i;
    Neighbours n(hn::LoadU(d, at));
    for (int bit = 0; bit < 9; ++bit)
      if (bit != 4) n.look(at + (bit / 3 - 1) * stride + bit % 3 - 1, bit);
    hn::StoreU(hn::BitCast(du, hn::AndNot(n.deeper, hn::Set(d, 0x1ef))), du, not_deeper + i);
    // A neighbour's label differs from its distance only where that decides nothing.
    const Distances least = label(n.centre);
    const auto is_centre = hn::And(hn::Lt(n.beside, hn::Add(least, hn::Set(d, 3))),
                                   hn::Lt(n.diagonal, hn::Add(least, hn::Set(d, 4))));
    set |= std::uint64_t{bits_of(d, hn::Gt(n.centre, hn::Zero(d)))} << i;
    centres |= std::uint64_t{bits_of(d, is_centre)} << i;
  }
  return set | (set & ~centres) << 32;
}

/// The greatest of 32 distances is in one of the lanes.
HWY_INLINE Distances greatest_of_32(const std::int16_t* distance) {
  const Tag d;
  Distances greatest = hn::Zero(d);
  for (std::size_t i = 0; i < 32; i += hn::Lanes(d))
    greatest = hn::Max(greatest, hn::LoadU(d, distance + i));
  return greatest;
}

/// Writes the words and `not_deeper` of all rows but the first and last; the greatest distance.
ChamferDistance classify_all(const ChamferDistance* distances, std::ptrdiff_t words_per_row,
                             std::vector<std::uint64_t>& words, std::uint16_t* not_deeper) {
  const auto* first = reinterpret_cast<const std::int16_t*>(distances);
  const auto row = static_cast<std::size_t>(words_per_row);
  const Tag d;
  Distances greatest = hn::Zero(d);
  for (std::size_t i = row; i + row < words.size(); ++i) {
    const Distances here = greatest_of_32(first + 32 * i);
    if (hn::AllTrue(d, hn::Eq(here, hn::Zero(d)))) continue;
    greatest = hn::Max(greatest, here);
    words[i] = classify(first + 32 * i, 32 * words_per_row, not_deeper + 32 * i);
  }
  std::int16_t lanes[32] = {};
  hn::StoreU(greatest, d, lanes);
  return static_cast<ChamferDistance>(*std::max_element(lanes, lanes + 32));
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(classify_all);

namespace {

bool any_of(const ChamferDistance* first, const ChamferDistance* last) {
  ChamferDistance any = 0;
  for (; first != last; ++first) any |= *first;
  return any != 0;
}

/// The box of the pixels that are not 0.
PixelBox support_of(const DistanceMap& map) {
  const int width = map.width();
  PixelBox box{width, 0, 0, map.height()};
  const auto is_empty = [&](int y) { return !any_of(map.row(y), map.row(y) + width); };
  while (box.top < box.bottom && is_empty(box.top)) ++box.top;
  if (box.top == box.bottom) return {};
  while (is_empty(box.bottom - 1)) --box.bottom;
  for (int y = box.top; y < box.bottom; ++y) {
    const ChamferDistance* row = map.row(y);
    // Only what would make the box wider is looked at.
    if (any_of(row, row + box.left)) {
      box.left = 0;
      while (row[box.left] == 0) ++box.left;
    }
    if (any_of(row + box.right, row + width)) {
      box.right = width;
      while (row[box.right - 1] == 0) --box.right;
    }
  }
  return box;
}

/// Makes the outermost loose bits of every word repeat the pixels next to it, as those of the set
/// do already.
void repeat_loose(std::vector<std::uint64_t>& words) {
  constexpr std::uint64_t kOwn = 0x7ffffffeffffffff;
  for (auto& word : words) word &= kOwn;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::uint64_t before = words[i - 1] >> 62 & 1, after = words[i + 1] >> 33 & 1;
    words[i] |= (before & words[i]) << 32 | (after & words[i] >> 31) << 63;
  }
}

}  // namespace

void ShrinkingSet::assign(const DistanceMap& map) {
  const PixelBox box = support_of(map);
  left_ = box.left;
  top_ = box.top;
  words_per_row_ = (box.right - box.left + kPixels - 1) / kPixels;
  for (int bit = 0; bit < 9; ++bit)
    step_[static_cast<std::size_t>(bit)] =
        static_cast<Pixel>(bit % 3 - 1 + 32 * words_per_row_ * (bit / 3 - 1));
  const std::ptrdiff_t rows = box.bottom - box.top + 2;  // with one above and one below
  words_.assign(static_cast<std::size_t>(rows * words_per_row_), 0);
  not_deeper_.resize(32 * words_.size());  // written where the set is
  distance_.assign(32 * words_.size() + 2 * kMargin, 0);
  ChamferDistance* target = &distance_[kMargin] + 32 * words_per_row_;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; x += kPixels, target += 32)
      if (x > 0 && x + kPixels < map.width())
        std::memcpy(target, map.row(y) + x - 1, 32 * sizeof *target);
      else  // at the edge of the image
        std::copy(map.row(y) + std::max(x - 1, 0),
                  map.row(y) + std::min(x + kPixels + 1, map.width()), target + (x == 0));
  greatest_distance_ = HWY_DYNAMIC_DISPATCH(classify_all)(&distance_[kMargin], words_per_row_,
                                                          words_, not_deeper_.data());
  repeat_loose(words_);
}

std::vector<ShrinkingSet::Pixel> pixels(const ShrinkingSet& set) {
  std::vector<ShrinkingSet::Pixel> result;
  for (std::size_t i = 0; i < set.word_count(); ++i)
    for (auto bits = set.in_word(i); bits != 0; bits &= bits - 1)
      result.push_back(static_cast<ShrinkingSet::Pixel>(32 * i) +
                       static_cast<ShrinkingSet::Pixel>(std::countr_zero(bits)));
  return result;
}

}  // namespace marrow
#endif
