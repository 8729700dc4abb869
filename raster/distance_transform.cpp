#include <algorithm>
#include <cassert>
#include <vector>

#include "distance_transform_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "distance_transform.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kAlong = 3, kDiagonal = 4;

#if HWY_TARGET == HWY_SCALAR

/// One row of the forward or backward pass; `previous` is the row before it in scan order, both
/// padded by one pixel on each side.
void relax_row(int* row, const int* previous, int width, int step) {
  const int first = step > 0 ? 1 : width, end = step > 0 ? width + 1 : 0;
  for (int x = first; x != end; x += step) {
    const int diagonal = std::min(previous[x - 1], previous[x + 1]) + kDiagonal;
    row[x] = std::min({row[x], row[x - step] + kAlong, previous[x] + kAlong, diagonal});
  }
}

void transform(const DistanceTask& task) {
  const auto& [silhouette, box, rim, target, stride] = task;
  const int width = box.right - box.left, height = box.bottom - box.top;
  constexpr int kFar = 1 << 20;
  Image<int> padded(width + 2, height + 2, kFar);
  for (int y = 0; y < height + 2; ++y) {
    padded(0, y) = kAlong * rim.left;
    padded(width + 1, y) = kAlong * rim.right;
  }
  std::fill_n(padded.row(0), width + 2, kAlong * rim.top);
  std::fill_n(padded.row(height + 1), width + 2, kAlong * rim.bottom);
  for (int y = 1; y <= height; ++y) {
    for (int x = 1; x <= width; ++x)
      if (!(*silhouette)(box.left + x - 1, box.top + y - 1)) padded(x, y) = 0;
    relax_row(padded.row(y), padded.row(y - 1), width, 1);
  }
  for (int y = height; y >= 1; --y) {
    relax_row(padded.row(y), padded.row(y + 1), width, -1);
    std::copy_n(padded.row(y) + 1, width, target + (y - 1) * stride);
  }
}

#else

using Distance = std::int16_t;
using Tag = hn::CappedTag<Distance, 8>;
using Block = hn::Vec<Tag>;

static_assert(hn::MaxLanes(Tag()) == kBlock);

// Along a row a distance is the least of all before it, with 3 added for every pixel between. Less
// a slope of 3 a pixel it is the plain minimum of all before. The slopes lie above all distances,
// so that these differences are negative and the zeros shifted into a block do not count.
constexpr int kSlope = 0x4000, kBackwardSlope = 0x7fff;

/// The blocks along a row that hold the box.
struct Blocks {
  int first, last;  ///< columns [first, last)
  int width;        ///< of the image, which may end in the last block
};

/// The least way to a block over the row before it.
HWY_INLINE Block across(const Distance* before) {
  const Tag d;
  const Block diagonal = hn::Min(hn::LoadU(d, before - 1), hn::LoadU(d, before + 1));
  return hn::Min(hn::Add(diagonal, hn::Set(d, kDiagonal)),
                 hn::Add(hn::LoadU(d, before), hn::Set(d, kAlong)));
}

HWY_INLINE std::uint64_t bits_of_block(const BitImage::Word* bits, int x) {
  const auto i = static_cast<unsigned>(x);
  return bits[i / 64] >> (i % 64) & 0xff;
}

/// `row` and `before` are indexed by column of the image; `target` is where the blocks start.
void forward(const Blocks& blocks, const BitImage::Word* bits, const Distance* before,
             Distance* row, ChamferDistance* target) {
  const Tag d;
  const hn::RebindToUnsigned<Tag> du;
  const auto [first, last, width] = blocks;
  const Block step = hn::Set(d, kAlong * kBlock);
  Block slope = hn::Add(hn::Mul(hn::Iota(d, 0), hn::Set(d, kAlong)),
                        hn::Set(d, static_cast<Distance>(kSlope + kAlong * first)));
  Block least = hn::Set(d, static_cast<Distance>(row[first - 1] - kSlope - kAlong * (first - 1)));
  for (int x = first; x < last; x += kBlock, slope = hn::Add(slope, step)) {
    const std::uint64_t mask = bits_of_block(bits, x);
    if (mask == 0) {
      hn::StoreU(hn::Zero(d), d, row + x);
      least = hn::Broadcast<kBlock - 1>(hn::Neg(slope));
      continue;
    }
    const auto inside = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&mask));
    Block v = hn::Sub(hn::IfThenElseZero(inside, across(before + x)), slope);
    v = hn::Min(v, hn::ShiftLeftLanes<1>(v));
    v = hn::Min(v, hn::ShiftLeftLanes<2>(v));
    v = hn::Min(hn::Min(v, hn::ShiftLeftLanes<4>(v)), least);
    least = hn::Broadcast<kBlock - 1>(v);
    v = hn::Add(v, slope);
    hn::StoreU(v, d, row + x);
    if (x + kBlock <= width) hn::StoreU(hn::BitCast(du, v), du, target + (x - first));
  }
  const int whole = width / kBlock * kBlock;
  if (whole < last) std::copy(row + whole, row + width, target + (whole - first));
}

void backward(const Blocks& blocks, const BitImage::Word* bits, const Distance* before,
              Distance* row, ChamferDistance* target) {
  const Tag d;
  const hn::RebindToUnsigned<Tag> du;
  const auto [first, last, width] = blocks;
  const int whole = width / kBlock * kBlock, end = last - kBlock;
  std::fill_n(row + end, kBlock, Distance{0});
  if (whole < last) std::copy_n(target + (whole - first), width - whole, row + whole);
  const Block step = hn::Set(d, kAlong * kBlock);
  Block slope = hn::Sub(hn::Set(d, static_cast<Distance>(kBackwardSlope - kAlong * end)),
                        hn::Mul(hn::Iota(d, 0), hn::Set(d, kAlong)));
  Block least = hn::Set(d, static_cast<Distance>(row[last] + kAlong * last - kBackwardSlope));
  for (int x = end; x >= first; x -= kBlock, slope = hn::Add(slope, step)) {
    if (bits_of_block(bits, x) == 0) {
      hn::StoreU(hn::Zero(d), d, row + x);
      least = hn::Broadcast<0>(hn::Neg(slope));
      continue;
    }
    const bool is_whole = x + kBlock <= width;
    Block v =
        is_whole ? hn::BitCast(d, hn::LoadU(du, target + (x - first))) : hn::LoadU(d, row + x);
    v = hn::Sub(hn::Min(v, across(before + x)), slope);
    v = hn::Min(v, hn::ShiftRightLanes<1>(d, v));
    v = hn::Min(v, hn::ShiftRightLanes<2>(d, v));
    v = hn::Min(hn::Min(v, hn::ShiftRightLanes<4>(d, v)), least);
    least = hn::Broadcast<0>(v);
    v = hn::Add(v, slope);
    hn::StoreU(v, d, row + x);
    if (is_whole) hn::StoreU(hn::BitCast(du, v), du, target + (x - first));
  }
  if (whole < last) std::copy(row + whole, row + width, target + (whole - first));
}

void transform(const DistanceTask& task) {
  const auto &box = task.box, &rim = task.rim;
  const int width = task.silhouette->width(), last = (box.right + kBlock - 1) / kBlock * kBlock;
  const Blocks blocks{box.left, last, width};
  const auto distance = [](int pixels) { return static_cast<Distance>(kAlong * pixels); };
  const auto size = static_cast<std::size_t>(last + 2 * kBlock);
  std::vector<Distance> row(size), before(size);  // with a block of margin on both sides
  const auto column = [&](int x) { return static_cast<std::size_t>(x + kBlock); };
  const auto start = [&](int above) {
    std::fill(before.begin(), before.end(), distance(above));
    row[column(box.left - 1)] = before[column(box.left - 1)] = distance(rim.left);
    row[column(last)] = before[column(last)] = distance(rim.right);
  };
  const auto run = [&](int y, const auto& pass) {
    pass(blocks, task.silhouette->row(y), &before[column(0)], &row[column(0)],
         task.target + (y - box.top) * task.stride);
    std::swap(row, before);
  };
  start(rim.top);
  for (int y = box.top; y < box.bottom; ++y) run(y, forward);
  start(rim.bottom);
  for (int y = box.bottom - 1; y >= box.top; --y) run(y, backward);
}

#endif

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(transform);

namespace {

void run(const DistanceTask& task) {
  [[maybe_unused]] constexpr int kGreatestSide = 4096;  // or the kernels would overflow
  assert(std::max(task.silhouette->width(), task.silhouette->height()) <= kGreatestSide);
  if (task.box.left < task.box.right && task.box.top < task.box.bottom)
    HWY_DYNAMIC_DISPATCH(transform)(task);
}

/// The least box of whole blocks that holds `box`.
PixelBox in_blocks(PixelBox box, const BitImage& image) {
  box.left = box.left / kBlock * kBlock;
  box.right = std::min((box.right + kBlock - 1) / kBlock * kBlock, image.width());
  return box;
}

}  // namespace

DistanceMap distance_transform(const BitImage& silhouette) {
  DistanceMap map(silhouette.width(), silhouette.height());
  const PixelBox box = in_blocks(bounding_box(silhouette), silhouette);
  run({&silhouette, box, {}, map.row(box.top) + box.left, map.width()});
  return map;
}

BoxedDistanceMap distance_transform(const BitImage& silhouette, const PixelBox& part) {
  const PixelBox box = in_blocks(part, silhouette);
  DistanceMap map(box.right - box.left, box.bottom - box.top);
  const PixelBox rim{box.left, silhouette.width() - box.right, box.top,
                     silhouette.height() - box.bottom};
  run({&silhouette, box, rim, map.row(0), map.width()});
  return {box, std::move(map)};
}

}  // namespace marrow
#endif
