#include <bit>

#include "fill_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "packed_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kBlock = 512;  // triangles that go through the stages together

/// Triangles on their way from one stage to the next.
struct Queue {
  std::uint32_t a[kBlock + kSlack], b[kBlock + kSlack], c[kBlock + kSlack];
  std::size_t size = 0;

  HWY_INLINE Corners corners(std::size_t i) const {
    const D d;
    return {hn::LoadU(d, a + i), hn::LoadU(d, b + i), hn::LoadU(d, c + i)};
  }
  /// Writes the chosen ones from place `at` on; the place after them.
  HWY_INLINE std::size_t push(std::size_t at, const Choice& chosen, const Corners& t) {
    chosen.store(t.a, a + at);
    chosen.store(t.b, b + at);
    chosen.store(t.c, c + at);
    return at + chosen.size();
  }
};

/// The pixel centres that triangles may hold: the lowest, and how many along x and y. Both packed.
struct Boxes {
  U32 low, count;
};

HWY_INLINE Boxes boxes_of(const Corners& t, int shift) {
  const U32 round_up = in_both_halves((1u << shift) - 1);
  const U32 low = shift_both(hn::Add(least(t), round_up), shift);
  const U32 high = shift_both(greatest(t), shift);
  return {low, hn::Sub(hn::Add(high, in_both_halves(1)), low)};
}

/// Edge functions at a pixel centre, and what they grow by to the next pixel along x and y.
struct Edges {
  Three<I32> value, right, up;
};

HWY_INLINE Edges edges_at(const Corners& t, U32 pixel, int shift) {
  const Int d;
  const U32 centre = hn::ShiftLeftSame(pixel, shift);
  const auto from_centre = [&](U32 p) HWY_ATTR { return hn::BitCast(d, hn::Sub(p, centre)); };
  const I32 a = from_centre(t.a), b = from_centre(t.b), c = from_centre(t.c);
  const auto x = [](I32 p) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(p)); };
  // A negative x has borrowed from y.
  const auto y = [&](I32 p) HWY_ATTR { return hn::ShiftRight<16>(hn::Add(p, hn::Set(d, 0x8000))); };
  const I32 ax = x(a), ay = y(a), bx = x(b), by = y(b), cx = x(c), cy = y(c);
  const auto cross = [](I32 px, I32 py, I32 qx, I32 qy)
                         HWY_ATTR { return hn::Sub(hn::Mul(px, qy), hn::Mul(py, qx)); };
  const auto steps = [shift](I32 from, I32 to)
                         HWY_ATTR { return hn::ShiftLeftSame(hn::Sub(to, from), shift); };
  return {{cross(ax, ay, bx, by), cross(bx, by, cx, cy), cross(cx, cy, ax, ay)},
          {steps(by, ay), steps(cy, by), steps(ay, cy)},
          {steps(ax, bx), steps(bx, cx), steps(cx, ax)}};
}

HWY_INLINE Three<I32> sum(const Three<I32>& p, const Three<I32>& q) {
  return {hn::Add(p.a, q.a), hn::Add(p.b, q.b), hn::Add(p.c, q.c)};
}

/// Whether the place where the edge functions have these values is in the triangle.
template <Facing kFacing>
HWY_INLINE auto is_inside(const Three<I32>& e) {
  const Int d;
  const auto none_negative = hn::Gt(hn::Min(hn::Min(e.a, e.b), e.c), hn::Set(d, -1));
  if constexpr (kFacing == Facing::CounterClockwise) {
    return hn::RebindMask(D(), none_negative);
  } else {
    const auto none_positive = hn::Lt(hn::Max(hn::Max(e.a, e.b), e.c), hn::Set(d, 1));
    return hn::RebindMask(D(), hn::Or(none_negative, none_positive));
  }
}

/// Fills the small triangles, a vector of them at a time, in three stages: which hold pixel centres
/// in their boxes; is the lowest, leftmost of them inside; are the others, three at most? What goes
/// from one stage to the next is packed together, so that all vectors are full.
template <Facing kFacing>
class Filler {
 public:
  Filler(const SnappedPoints& points, std::span<const Triangle> triangles, int resolution)
      : points_(points),
        triangles_(triangles),
        shift_(lattice_shift(resolution)),
        result_{BitImage(resolution, resolution), {}} {}

  /// Fills the triangles from number `begin` to before `end`, kBlock at most. All together must be
  /// enough for a vector.
  void fill_block(std::size_t begin, std::size_t end) {
    sort_by_size(begin, end);
    keep_large();
    test_first_pixels();
    test_other_pixels();
    for (std::size_t i = 0; i < pixel_count_; ++i)
      result_.mask.set(static_cast<int>(pixels_[i] & 0xffff), static_cast<int>(pixels_[i] >> 16));
  }

  TriangleFill result() && { return std::move(result_); }

 private:
  // In the loops the sizes of the queues are local: for all that the compiler knows, the vectors
  // that are stored could change the members.

  /// Those that hold no pixel centre stay behind, the small ones go to the next stage.
  void sort_by_size(std::size_t begin, std::size_t end) {
    const D d;
    const std::uint32_t* const points = points_.packed();
    const int shift = shift_;
    std::size_t small = 0, large = 0;
    for (std::size_t at = begin; at < end; at += hn::Lanes(d)) {
      // In the last vector some triangles are taken again.
      const std::size_t i = std::min(at, triangles_.size() - hn::Lanes(d));
      const Corners t = gather_corners(points, triangles_[i].data());
      const U32 count = boxes_of(t, shift).count;
      const auto is_small =
          hn::Eq(hn::And(hn::Sub(count, in_both_halves(1)), in_both_halves(0xfffe)), hn::Zero(d));
      small = small_.push(small, Choice(is_small), t);
      const auto is_large =
          hn::Ne(hn::And(hn::Add(count, in_both_halves(1)), in_both_halves(0xfffc)), hn::Zero(d));
      if (!hn::AllFalse(d, is_large)) large = large_.push(large, Choice(is_large), t);
    }
    small_.size = small, large_.size = large;
  }

  static HWY_INLINE Corners gather_corners(const std::uint32_t* points,
                                           const std::uint32_t* triangles) {
    const D d;
    U32 a, b, c;
    hn::LoadInterleaved3(d, triangles, a, b, c);
    const auto point = [&](U32 i)
                           HWY_ATTR { return hn::GatherIndex(d, points, hn::BitCast(Int(), i)); };
    return {point(a), point(b), point(c)};
  }

  void keep_large() {
    const auto append = [&](std::vector<std::uint32_t>& all, const std::uint32_t* some) {
      all.insert(all.end(), some, some + large_.size);
    };
    append(result_.large.a, large_.a);
    append(result_.large.b, large_.b);
    append(result_.large.c, large_.c);
  }

  void test_first_pixels() {
    const D d;
    const int shift = shift_;
    std::size_t pixels = 0, several = 0;
    for (std::size_t i = 0; i < small_.size; i += hn::Lanes(d)) {
      const auto is_there = hn::FirstN(d, small_.size - i);
      const Corners t = small_.corners(i);
      const Boxes box = boxes_of(t, shift);
      const Choice hits(hn::And(is_there, is_inside<kFacing>(edges_at(t, box.low, shift).value)));
      hits.store(box.low, pixels_ + pixels);
      pixels += hits.size();
      const auto has_more = hn::And(is_there, hn::Ne(box.count, in_both_halves(1)));
      several = several_.push(several, Choice(has_more), t);
    }
    pixel_count_ = pixels, several_.size = several;
  }

  void test_other_pixels() {
    const D d;
    const U32 right = hn::Set(d, 1), up = hn::Set(d, 1 << 16);
    for (std::size_t i = 0; i < several_.size; i += hn::Lanes(d)) {
      const auto is_there = hn::FirstN(d, several_.size - i);
      const Corners t = several_.corners(i);
      const Boxes box = boxes_of(t, shift_);
      const Edges e = edges_at(t, box.low, shift_);
      const auto test = [&](U32 step, const Three<I32>& value) HWY_ATTR {
        const U32 two = hn::Add(step, step);
        const auto in_box = hn::Eq(hn::And(box.count, two), two);
        const Choice hits(hn::And(hn::And(is_there, in_box), is_inside<kFacing>(value)));
        hits.store(hn::Add(box.low, step), pixels_ + pixel_count_);
        pixel_count_ += hits.size();
      };
      const Three<I32> above = sum(e.value, e.up);
      test(right, sum(e.value, e.right));
      test(up, above);
      test(hn::Add(right, up), sum(above, e.right));
    }
  }

  const SnappedPoints& points_;
  std::span<const Triangle> triangles_;
  int shift_;
  TriangleFill result_;
  Queue small_, several_, large_;
  std::uint32_t pixels_[4 * kBlock + kSlack];  // to be set
  std::size_t pixel_count_ = 0;
};

template <Facing kFacing>
TriangleFill fill_blocks(const SnappedPoints& points, std::span<const Triangle> triangles,
                         int resolution) {
  Filler<kFacing> filler(points, triangles, resolution);
  for (std::size_t i = 0; i < triangles.size(); i += kBlock)
    filler.fill_block(i, std::min(i + kBlock, triangles.size()));
  return std::move(filler).result();
}

TriangleFill fill_on_target(const SnappedPoints& points, std::span<const Triangle> triangles,
                            Facing facing, int resolution) {
  const std::size_t lanes = hn::Lanes(D());
  if (triangles.empty()) return {BitImage(resolution, resolution), {}};
  if (triangles.size() < lanes) {
    std::vector<Triangle> repeated(triangles.begin(), triangles.end());
    repeated.resize(lanes, triangles.back());
    return fill_on_target(points, repeated, facing, resolution);
  }
  return facing == Facing::Both
             ? fill_blocks<Facing::Both>(points, triangles, resolution)
             : fill_blocks<Facing::CounterClockwise>(points, triangles, resolution);
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(fill_on_target);

int lattice_shift(int resolution) {
  return std::countr_zero(static_cast<unsigned>(subpixels_of(resolution)));
}

TriangleFill fill(const SnappedPoints& points, std::span<const Triangle> triangles, Facing facing,
                  int resolution) {
  TriangleFill result = HWY_DYNAMIC_DISPATCH(fill_on_target)(points, triangles, facing, resolution);
  fill_large(result.mask, result.large, facing, lattice_shift(resolution));
  return result;
}

BitImage fill_triangles(const SnappedPoints& points, std::span<const Triangle> triangles,
                        int resolution) {
  return fill(points, triangles, Facing::Both, resolution).mask;
}

}  // namespace marrow
#endif
