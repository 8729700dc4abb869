#include <algorithm>
#include <bit>

#include "vote_support_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vote_support.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;  // a vote in each lane
using Int = hn::Rebind<std::int32_t, D>;
using F64 = hn::Vec<D>;
using I32 = hn::Vec<Int>;

constexpr std::size_t kMostLanes = hn::MaxLanes(D());

struct Positions {
  F64 x, y, z;
};

/// The pixel of a coordinate; all operations as in Projections and nearest().
HWY_INLINE I32 pixel_along(const Vec3& axis, double middle, const Positions& p) {
  const D d;
  const F64 x = hn::Mul(hn::Set(d, axis.x), p.x), y = hn::Mul(hn::Set(d, axis.y), p.y),
            z = hn::Mul(hn::Set(d, axis.z), p.z);
  const F64 coordinate = hn::Add(hn::Add(hn::Add(x, y), z), hn::Set(d, middle));
  return hn::DemoteTo(Int(), hn::Floor(hn::Add(coordinate, hn::Set(d, 0.5))));
}

/// How far away the axis is at these pixels.
HWY_INLINE I32 look_up(const SupportImage& image, I32 x, I32 y) {
  const Int d;
  const I32 zero = hn::Zero(d);
  const I32 column = hn::Sub(x, hn::Set(d, image.left)), row = hn::Sub(y, hn::Set(d, image.top));
  const auto is_low = hn::Or(hn::Lt(column, zero), hn::Lt(row, zero));
  const auto is_high = hn::Or(hn::Gt(column, hn::Set(d, image.width - 1)),
                              hn::Gt(row, hn::Set(d, image.height - 1)));
  const I32 place = hn::Add(hn::Add(column, hn::Set(d, 1)), hn::Mul(row, hn::Set(d, image.width)));
  std::int32_t places[kMostLanes], found[kMostLanes];
  hn::StoreU(hn::IfThenElse(hn::Or(is_low, is_high), zero, place), d, places);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i)
    found[i] = image.away[static_cast<std::size_t>(places[i])];
  return hn::LoadU(d, found);
}

/// Counts for the votes in a vector: images less far away than `narrow`, and than `broad`.
HWY_INLINE void count_near(const Projections& project, std::span<const SupportImage> images,
                           const Positions& p, I32 narrow, I32 broad, VoteSupport* result) {
  const Int d;
  const I32 outside = hn::Set(d, SupportImage::kOutside);
  I32 is_inside = hn::Set(d, -1), narrowly = hn::Zero(d), broadly = narrowly;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto& [u, v] = project.plane(i);
    const I32 away = look_up(images[i], pixel_along(u, project.middle(), p),
                             pixel_along(v, project.middle(), p));
    is_inside = hn::And(is_inside, hn::VecFromMask(d, hn::Ne(away, outside)));
    if (hn::AllTrue(d, hn::Eq(is_inside, hn::Zero(d)))) break;
    narrowly = hn::Sub(narrowly, hn::VecFromMask(d, hn::Lt(away, narrow)));
    broadly = hn::Sub(broadly, hn::VecFromMask(d, hn::Lt(away, broad)));
  }
  std::int32_t counts[3][kMostLanes];
  hn::StoreU(is_inside, d, counts[0]);
  hn::StoreU(narrowly, d, counts[1]);
  hn::StoreU(broadly, d, counts[2]);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i)
    result[i] = {counts[1][i], counts[2][i], counts[0][i] != 0};
}

/// The last vector may take votes again.
void support_on_target(const Projections& project, std::span<const SupportImage> images,
                       std::span<const Vec3> positions, std::int32_t narrow,
                       std::span<const std::int32_t> broad, std::vector<VoteSupport>& result) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t at = 0; at < positions.size(); at += lanes) {
    double x[kMostLanes], y[kMostLanes], z[kMostLanes];
    std::int32_t most[kMostLanes];
    VoteSupport support[kMostLanes];
    for (std::size_t i = 0; i < lanes; ++i) {
      const std::size_t k = std::min(at + i, positions.size() - 1);
      x[i] = positions[k].x, y[i] = positions[k].y, z[i] = positions[k].z;
      most[i] = broad[k] + 1;
    }
    count_near(project, images, {hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)},
               hn::Set(Int(), narrow + 1), hn::LoadU(Int(), most), support);
    std::copy_n(support, std::min(lanes, positions.size() - at), &result[at]);
  }
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(support_on_target);

SupportImage::SupportImage(const ViewImage& image, const BitImage& mask)
    : left(image.to_axis.box().left),
      top(image.to_axis.box().top),
      width(image.to_axis.box().right - left),
      height(image.to_axis.box().bottom - top),
      away(1 + static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kOutside) {
  auto to = away.begin() + 1;
  for (int y = top; y < top + height; ++y, to += width) {
    const BitImage::Word* const row = mask.row(y);
    const auto from = image.to_axis.row(y);
    for (int x = left; x < left + width;) {
      // As many pixels as there are alike, up to the end of the word.
      const bool is_in = (row[x / 64] >> x % 64 & 1) != 0;
      const BitImage::Word others = (is_in ? ~row[x / 64] : row[x / 64]) >> x % 64;
      const int end =
          std::min({left + width, x / 64 * 64 + 64, x + (others ? std::countr_zero(others) : 64)});
      if (is_in) std::copy(from + (x - left), from + (end - left), to + (x - left));
      x = end;
    }
  }
}

std::vector<VoteSupport> vote_support(const Projections& project,
                                      std::span<const SupportImage> images,
                                      std::span<const Vec3> positions, std::int32_t narrow,
                                      std::span<const std::int32_t> broad) {
  std::vector<VoteSupport> result(positions.size());
  HWY_DYNAMIC_DISPATCH(support_on_target)(project, images, positions, narrow, broad, result);
  return result;
}

}  // namespace marrow
#endif
