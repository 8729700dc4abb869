#include <marrow/silhouette.hpp>

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "snap.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The way of one coordinate of the image from the shape to the lattice.
struct LatticeAxis {
  float x, y, z, scale, offset;
};

struct Coordinates {
  const float *x, *y, *z;
};

template <class D>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> truncate(D, hn::Vec<D> v) {
  const hn::RebindToSigned<D> di;
#if HWY_TARGET == HWY_SCALAR  // where ConvertTo() looks for numbers that do not fit
  return hn::Set(di, static_cast<std::int32_t>(hn::GetLane(v)));
#else
  return hn::ConvertTo(di, v);
#endif
}

/// Lattice coordinates of as many points as `d` has lanes, from `i` on. Multiplies and adds apart,
/// never fused: the last bit is the same on every machine.
template <class D>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> along_axis(D d, const Coordinates& p,
                                                     const LatticeAxis& axis, std::size_t i) {
  const auto x = hn::Mul(hn::Set(d, axis.x), hn::LoadU(d, p.x + i));
  const auto y = hn::Mul(hn::Set(d, axis.y), hn::LoadU(d, p.y + i));
  const auto z = hn::Mul(hn::Set(d, axis.z), hn::LoadU(d, p.z + i));
  const auto along = hn::Add(hn::Add(x, y), z);
  // Positive, so that the conversion's truncation is a floor.
  return truncate(d, hn::Add(hn::Mul(along, hn::Set(d, axis.scale)), hn::Set(d, axis.offset)));
}

/// Snaps points from `i` on as long as there are as many as lanes; where it ended.
template <class D>
std::size_t snap_points(D d, const Coordinates& p, const LatticeAxis& u, const LatticeAxis& v,
                        std::size_t i, SnappedPoints& points) {
  const hn::RebindToUnsigned<D> du;
  const std::size_t lanes = hn::Lanes(d), count = points.size();
  std::uint32_t* const packed = points.packed();
  for (; i + lanes <= count; i += lanes) {
    const auto x = along_axis(d, p, u, i), y = along_axis(d, p, v, i);
    hn::StoreU(hn::BitCast(du, hn::Or(x, hn::ShiftLeft<16>(y))), du, packed + i);
  }
  return i;
}

SnappedPoints snap_on_target(const NormalizedShape& shape, const ViewPlane& plane, int resolution) {
  const PixelGrid pixels{resolution};
  const double steps = subpixels_of(resolution);
  const auto lattice_axis = [&](const Vec3& axis) {
    return LatticeAxis{static_cast<float>(axis.x), static_cast<float>(axis.y),
                       static_cast<float>(axis.z), static_cast<float>(steps / pixels.pixel()),
                       static_cast<float>(0.5 * (resolution - 1) * steps + 0.5)};
  };
  const LatticeAxis u = lattice_axis(plane.u), v = lattice_axis(plane.v);
  SnappedPoints points(shape.x.size());
  const Coordinates p{shape.x.data(), shape.y.data(), shape.z.data()};
  const std::size_t rest = snap_points(hn::ScalableTag<float>(), p, u, v, 0, points);
  snap_points(hn::CappedTag<float, 1>(), p, u, v, rest, points);
  return points;
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(snap_on_target);

namespace {

constexpr int kLatticeBits = 15;

}  // namespace

int subpixels_of(int resolution) {
  const int limit = (1 << kLatticeBits) / resolution;
  return static_cast<int>(std::bit_floor(static_cast<unsigned>(limit)));
}

SnappedPoints snap(const NormalizedShape& shape, const ViewPlane& plane, int resolution) {
  return HWY_DYNAMIC_DISPATCH(snap_on_target)(shape, plane, resolution);
}

}  // namespace marrow
#endif
