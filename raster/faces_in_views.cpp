#include <algorithm>
#include <bit>
#include <cstring>

#include "faces_in_views_detail.hpp"
#include "lattice_triangle_detail.hpp"
#include "mask_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "faces_in_views.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 64>;  // an image in each lane
using Int = hn::RebindToSigned<F>;
using F32 = hn::Vec<F>;
using I32 = hn::Vec<Int>;

/// A point on the lattices of all images.
struct SnappedInViews {
  alignas(64) std::array<std::int32_t, kMostViews> x, y;
};

/// Of what is not negative and less than 2^22. A conversion would look for numbers that do not fit.
HWY_INLINE I32 truncate(F32 v) {
  const F d;
  constexpr float kUnits = 0x1p23f;  // from here on the last bit of a float is a one
  const Int di;
  const I32 bits = hn::BitCast(di, hn::Add(hn::Floor(v), hn::Set(d, kUnits)));
  return hn::And(bits, hn::Set(di, 0x7fffff));
}

/// The same operations in the same order as in snap().
HWY_INLINE I32 along_axis(const ViewAxes::Axis& axis, std::size_t i, F32 px, F32 py, F32 pz,
                          F32 scale, F32 offset) {
  const F d;
  const F32 x = hn::Mul(hn::LoadU(d, &axis.x[i]), px);
  const F32 y = hn::Mul(hn::LoadU(d, &axis.y[i]), py);
  const F32 z = hn::Mul(hn::LoadU(d, &axis.z[i]), pz);
  return truncate(hn::Add(hn::Mul(hn::Add(hn::Add(x, y), z), scale), offset));
}

/// Snaps points, and remembers the last ones: triangles that share a point are mostly near each
/// other.
class SnappedCorners {
 public:
  SnappedCorners(const NormalizedShape& shape, const ViewAxes& axes)
      : shape_(shape), axes_(axes), points_(kSlots + 3) {
    number_.fill(~0u);
  }

  std::array<const SnappedInViews*, 3> of(const Triangle& t) {
    std::array<const SnappedInViews*, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      std::size_t slot = t[i] % kSlots;
      const bool is_taken = (i > 0 && t[0] % kSlots == slot && t[0] != t[i]) ||
                            (i > 1 && t[1] % kSlots == slot && t[1] != t[i]);
      if (is_taken)
        snap(t[i], slot = kSlots + i);
      else if (number_[slot] != t[i])
        snap(t[i], slot), number_[slot] = t[i];
      result[i] = &points_[slot];
    }
    return result;
  }

 private:
  static constexpr std::size_t kSlots = 512;

  void snap(std::uint32_t point, std::size_t slot) {
    const F d;
    const Int di;
    SnappedInViews& to = points_[slot];
    const F32 x = hn::Set(d, shape_.x[point]), y = hn::Set(d, shape_.y[point]),
              z = hn::Set(d, shape_.z[point]);
    const F32 scale = hn::Set(d, axes_.scale), offset = hn::Set(d, axes_.offset);
    for (std::size_t i = 0; i < axes_.count; i += hn::Lanes(d)) {
      hn::StoreU(along_axis(axes_.u, i, x, y, z, scale, offset), di, &to.x[i]);
      hn::StoreU(along_axis(axes_.v, i, x, y, z, scale, offset), di, &to.y[i]);
    }
  }

  const NormalizedShape& shape_;
  const ViewAxes& axes_;
  std::vector<SnappedInViews> points_;
  std::array<std::uint32_t, kSlots> number_;
};

/// A bit for every lane.
HWY_INLINE ViewBits bits_of(hn::Mask<Int> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Int(), mask, bytes);
  if (hn::MaxLanes(Int()) <= 8) return bytes[0];
  std::uint16_t two;
  std::memcpy(&two, bytes, 2);
  if (hn::MaxLanes(Int()) <= 16) return two;
  ViewBits all = 0;
  for (unsigned i = 0; i < 8; ++i) all |= ViewBits{bytes[i]} << 8 * i;
  return all;
}

HWY_INLINE I32 load(const std::array<std::int32_t, kMostViews>& values, std::size_t i) {
  return hn::LoadU(Int(), &values[i]);
}

using Corners = std::array<const SnappedInViews*, 3>;

/// Twice the area in the images from `i` on.
HWY_INLINE I32 twice_area(const Corners& p, std::size_t i) {
  const I32 x = load(p[0]->x, i), y = load(p[0]->y, i);
  const I32 bx = hn::Sub(load(p[1]->x, i), x), by = hn::Sub(load(p[1]->y, i), y);
  const I32 cx = hn::Sub(load(p[2]->x, i), x), cy = hn::Sub(load(p[2]->y, i), y);
  return hn::Sub(hn::Mul(bx, cy), hn::Mul(cx, by));
}

void look_on_target(const FacesTask& task) {
  const Int d;
  const NormalizedShape& shape = *task.shape;
  const std::size_t count = task.axes->count;
  const ViewBits valid = task.axes->valid();
  SnappedCorners snapped(shape, *task.axes);
  const I32 zero = hn::Zero(d);
  for (std::size_t t = task.first; t < task.last; ++t) {
    const Corners corners = snapped.of(shape.triangles[t]);
    ViewBits front = 0, flat = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      const I32 area = twice_area(corners, i);
      front |= bits_of(hn::Gt(area, zero)) << i;
      flat |= bits_of(hn::Eq(area, zero)) << i;
    }
    task.front[t] = front & valid;
    if ((flat & valid) != 0) task.flat->add(flat & valid, static_cast<std::uint32_t>(t));
  }
}

/// Where [least, greatest] has something of a range.
HWY_INLINE hn::Mask<Int> meets(I32 least, I32 greatest, const SomePixels::Range& range,
                               std::size_t i) {
  const I32 below = hn::Sub(load(range.low, i), hn::Set(Int(), 1));
  return hn::And(hn::Lt(least, load(range.high, i)), hn::Gt(greatest, below));
}

/// The images in which a triangle has something in the box of the pixels.
HWY_INLINE ViewBits in_box(const Corners& p, std::size_t count, const SomePixels& pixels) {
  const auto along = [&](const SomePixels::Range& range, std::size_t i, I32 a, I32 b,
                         I32 c) HWY_ATTR {
    return meets(hn::Min(hn::Min(a, b), c), hn::Max(hn::Max(a, b), c), range, i);
  };
  ViewBits bits = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(Int()))
    bits |=
        bits_of(hn::And(along(pixels.x, i, load(p[0]->x, i), load(p[1]->x, i), load(p[2]->x, i)),
                        along(pixels.y, i, load(p[0]->y, i), load(p[1]->y, i), load(p[2]->y, i))))
        << i;
  return bits;
}

/// The box of some triangles.
struct Box {
  std::array<float, 3> middle, half;

  Box(const NormalizedShape& s, std::size_t first, std::size_t last) {
    std::array<float, 3> low{2, 2, 2}, high{-2, -2, -2};
    for (std::size_t t = first; t < last; ++t)
      for (const std::uint32_t i : s.triangles[t]) {
        const std::array<float, 3> p{s.x[i], s.y[i], s.z[i]};
        for (std::size_t k = 0; k < 3; ++k)
          low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
      }
    for (std::size_t k = 0; k < 3; ++k)
      middle[k] = 0.5F * (low[k] + high[k]), half[k] = 0.5F * (high[k] - low[k]);
  }
};

/// What a box may cover along one axis of every image.
struct BoxRange {
  alignas(64) std::array<std::int32_t, kMostViews> least, greatest;

  BoxRange(const Box& box, const ViewAxes& axes, const ViewAxes::Axis& axis) {
    const F d;
    const Int di;
    const F32 scale = hn::Set(d, axes.scale), offset = hn::Set(d, axes.offset);
    const auto sum = [&](const std::array<float, 3>& to, F32 x, F32 y, F32 z) HWY_ATTR {
      return hn::Mul(scale,
                     hn::Add(hn::Add(hn::Mul(x, hn::Set(d, to[0])), hn::Mul(y, hn::Set(d, to[1]))),
                             hn::Mul(z, hn::Set(d, to[2]))));
    };
    for (std::size_t i = 0; i < axes.count; i += hn::Lanes(d)) {
      const F32 x = hn::LoadU(d, &axis.x[i]), y = hn::LoadU(d, &axis.y[i]),
                z = hn::LoadU(d, &axis.z[i]);
      const F32 middle = hn::Add(sum(box.middle, x, y, z), offset);
      const F32 reach =
          hn::Add(sum(box.half, hn::Abs(x), hn::Abs(y), hn::Abs(z)), hn::Set(d, kRounding));
      const F32 most = hn::Set(d, 0x7fff), none = hn::Zero(d);
      hn::StoreU(truncate(hn::Max(hn::Sub(middle, reach), none)), di, &least[i]);
      hn::StoreU(truncate(hn::Min(hn::Add(middle, reach), most)), di, &greatest[i]);
    }
  }

 private:
  static constexpr float kRounding = 4;  // lattice steps
};

/// The images in which some triangles may have one of the pixels in the box of theirs.
ViewBits pixels_near(const Box& box, const ViewAxes& axes, const SomePixels& pixels) {
  const Int d;
  const BoxRange x(box, axes, axes.u), y(box, axes, axes.v);
  ViewBits bits = 0;
  for (std::size_t i = 0; i < axes.count; i += hn::Lanes(d))
    bits |= bits_of(hn::And(meets(load(x.least, i), load(x.greatest, i), pixels.x, i),
                            meets(load(y.least, i), load(y.greatest, i), pixels.y, i)))
            << i;
  bits &= axes.valid();
  const int shift = lattice_shift(axes.resolution), last = axes.resolution - 1;
  const auto pixel = [&](std::int32_t c) { return std::min(nearest_pixel(c, shift), last); };
  for (ViewBits left = bits; left != 0; left &= left - 1) {
    const auto v = static_cast<std::size_t>(std::countr_zero(left));
    const PixelBox there{pixel(x.least[v]), pixel(x.greatest[v]) + 1, pixel(y.least[v]),
                         pixel(y.greatest[v]) + 1};
    if (!is_any_set(pixels.image(v), there)) bits &= ~(ViewBits{1} << v);
  }
  return bits;
}

void look_for_pixels_on_target(const PixelsTask& task) {
  constexpr std::size_t kTogether = 64;  // triangles
  SnappedCorners snapped(*task.shape, *task.axes);
  for (std::size_t first = task.first; first < task.last; first += kTogether) {
    const std::size_t last = std::min(first + kTogether, task.last);
    const ViewBits views = pixels_near(Box(*task.shape, first, last), *task.axes, *task.pixels);
    if (views == 0) continue;
    for (std::size_t t = first; t < last; ++t) {
      const Corners corners = snapped.of(task.shape->triangles[t]);
      const ViewBits found = views & in_box(corners, task.axes->count, *task.pixels);
      if (found != 0) task.found->add(found, static_cast<std::uint32_t>(t));
    }
  }
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(look_on_target);
HWY_EXPORT(look_for_pixels_on_target);

void look_at_faces(const FacesTask& task) { HWY_DYNAMIC_DISPATCH(look_on_target)(task); }

void look_for_pixels(const PixelsTask& task) {
  HWY_DYNAMIC_DISPATCH(look_for_pixels_on_target)(task);
}

SomePixels::SomePixels(std::span<const BitImage> images) : images_(images) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    const int shift = lattice_shift(images[i].width()), half = 1 << shift >> 1;
    const PixelBox box = bounding_box(images[i]);
    const auto set = [&](Range& range, int first, int end) {
      range.low[i] = (first << shift) - half, range.high[i] = (end << shift) - half;
    };
    set(x, box.left, box.right), set(y, box.top, box.bottom);
    if (box.left != box.right) is_empty_ = false;
  }
}

ViewAxes::ViewAxes(std::span<const ViewPlane> planes, int side)
    : scale(static_cast<float>(subpixels_of(side) / PixelGrid{side}.pixel())),
      offset(static_cast<float>(0.5 * (side - 1) * subpixels_of(side) + 0.5)),
      count(planes.size()),
      resolution(side) {
  const auto set = [](Axis& axis, std::size_t i, const Vec3& to) {
    axis.x[i] = static_cast<float>(to.x);
    axis.y[i] = static_cast<float>(to.y);
    axis.z[i] = static_cast<float>(to.z);
  };
  for (std::size_t i = 0; i < count; ++i) set(u, i, planes[i].u), set(v, i, planes[i].v);
}

}  // namespace marrow
#endif
