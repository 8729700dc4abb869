#include <bit>
#include <numeric>

#include "fill_detail.hpp"
#include "lattice_triangle_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef MARROW_PACK_TABLE
#define MARROW_PACK_TABLE
namespace marrow {

/// For every set of up to eight lanes their numbers, then zeros.
inline constexpr auto kPackTable = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t bits = 0; bits < 256; ++bits) {
    std::size_t size = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane)
      if ((bits >> lane & 1) != 0) table[bits][size++] = lane;
  }
  return table;
}();

}  // namespace marrow
#endif

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

TriangleFill fill_on_target(const SnappedPoints& points, std::span<const Triangle> triangles,
                            Facing facing, int resolution) {
  const int shift = lattice_shift(resolution);
  TriangleFill result{BitImage(resolution, resolution), {}};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    LatticeTriangle t(points, triangles[i], shift);
    if (t.right - t.left > 1 || t.high - t.low > 1)
      result.large.push_back(static_cast<std::uint32_t>(i));
    if (t.misses_all_centres()) continue;
    if (facing == Facing::CounterClockwise && t.twice_area() < 0) continue;
    if (t.left == t.right && t.low == t.high && result.mask(t.left, t.low)) continue;
    t.orient();
    fill_exactly(result.mask, t, shift);
  }
  return result;
}

#else

using D = hn::ScalableTag<std::uint32_t>;       // a point in each lane, packed
using Half = hn::Repartition<std::int16_t, D>;  // their coordinates, x and y by turns
using Int = hn::RebindToSigned<D>;
using U32 = hn::Vec<D>;
using I32 = hn::Vec<Int>;

constexpr std::size_t kBlock = 512;  // triangles that go through the stages together
// Highway 1.0 packs AVX2 and SSE vectors by a table that GCC copies every time.
#define MARROW_PACK_BY_TABLE (HWY_ARCH_X86 && HWY_TARGET > HWY_AVX3)

constexpr std::size_t kSlack = hn::MaxLanes(D());  // whole vectors are written

/// One value of every triangle of a vector for each corner, or each edge from a corner to the next.
template <class V>
struct Three {
  V a, b, c;
};

using Corners = Three<U32>;

/// Some lanes of a vector, to be packed together.
class Choice {
 public:
  explicit Choice(hn::Mask<D> mask) : mask_(mask), size_(hn::CountTrue(D(), mask)) {
#if MARROW_PACK_BY_TABLE
    const D d;
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    const hn::Rebind<std::uint8_t, D> bytes;
    lanes_ = hn::IndicesFromVec(d, hn::PromoteTo(d, hn::LoadU(bytes, kPackTable[bits[0]].data())));
#endif
  }

  std::size_t size() const { return size_; }
  U32 pack(U32 v) const {
#if MARROW_PACK_BY_TABLE
    return hn::TableLookupLanes(v, lanes_);
#else
    return hn::Compress(v, mask_);
#endif
  }

 private:
  hn::Mask<D> mask_;
  std::size_t size_;
#if MARROW_PACK_BY_TABLE
  decltype(hn::IndicesFromVec(D(), U32())) lanes_;
#endif
};

/// Triangles on their way from one stage to the next.
struct Queue {
  std::uint32_t a[kBlock + kSlack], b[kBlock + kSlack], c[kBlock + kSlack];
  std::size_t size = 0;

  Corners operator[](std::size_t i) const {
    const D d;
    return {hn::LoadU(d, a + i), hn::LoadU(d, b + i), hn::LoadU(d, c + i)};
  }
  void push(const Choice& chosen, const Corners& t) {
    const D d;
    hn::StoreU(chosen.pack(t.a), d, a + size);
    hn::StoreU(chosen.pack(t.b), d, b + size);
    hn::StoreU(chosen.pack(t.c), d, c + size);
    size += chosen.size();
  }
};

/// Words on their way out of the vectors: pixels, or numbers of triangles.
template <std::size_t kMost>
struct Words {
  std::uint32_t words[kMost + kSlack];
  std::size_t size = 0;

  void push(const Choice& chosen, U32 values) {
    hn::StoreU(chosen.pack(values), D(), words + size);
    size += chosen.size();
  }
};

/// The pixel centres that triangles may hold: the lowest, packed, and how many more there are
/// along x and y, less than none where there is none at all.
struct Boxes {
  U32 low, extent;
};

Boxes boxes_of(const Corners& t, int shift) {
  const D d;
  const Half h;
  const auto a = hn::BitCast(h, t.a), b = hn::BitCast(h, t.b), c = hn::BitCast(h, t.c);
  const auto round_up = hn::Set(h, static_cast<std::int16_t>((1 << shift) - 1));
  const auto low = hn::ShiftRightSame(hn::Add(hn::Min(hn::Min(a, b), c), round_up), shift);
  const auto high = hn::ShiftRightSame(hn::Max(hn::Max(a, b), c), shift);
  return {hn::BitCast(d, low), hn::BitCast(d, hn::Sub(high, low))};
}

/// Edge functions at a pixel centre, and what they grow by to the next pixel along x and y.
struct Edges {
  Three<I32> value, right, up;
};

Edges edges_at(const Corners& t, U32 pixel, int shift) {
  const Int d;
  const Half h;
  const auto centre = hn::ShiftLeftSame(hn::BitCast(h, pixel), shift);
  const auto from_centre = [&](U32 p) {
    return hn::BitCast(d, hn::Sub(hn::BitCast(h, p), centre));
  };
  const I32 a = from_centre(t.a), b = from_centre(t.b), c = from_centre(t.c);
  const auto x = [](I32 p) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(p)); };
  const auto y = [](I32 p) { return hn::ShiftRight<16>(p); };
  const I32 ax = x(a), ay = y(a), bx = x(b), by = y(b), cx = x(c), cy = y(c);
  const auto cross = [](I32 px, I32 py, I32 qx, I32 qy) {
    return hn::Sub(hn::Mul(px, qy), hn::Mul(py, qx));
  };
  const auto steps = [shift](I32 from, I32 to) {
    return hn::ShiftLeftSame(hn::Sub(to, from), shift);
  };
  return {{cross(ax, ay, bx, by), cross(bx, by, cx, cy), cross(cx, cy, ax, ay)},
          {steps(by, ay), steps(cy, by), steps(ay, cy)},
          {steps(ax, bx), steps(bx, cx), steps(cx, ax)}};
}

Three<I32> sum(const Three<I32>& p, const Three<I32>& q) {
  return {hn::Add(p.a, q.a), hn::Add(p.b, q.b), hn::Add(p.c, q.c)};
}

/// Whether the place where the edge functions have these values is in the triangle.
template <Facing kFacing>
auto is_inside(const Three<I32>& e) {
  const Int d;
  const auto none_negative = hn::Gt(hn::Min(hn::Min(e.a, e.b), e.c), hn::Set(d, -1));
  if constexpr (kFacing == Facing::CounterClockwise) {
    return hn::RebindMask(D(), none_negative);
  } else {
    const auto none_positive = hn::Lt(hn::Max(hn::Max(e.a, e.b), e.c), hn::Set(d, 1));
    return hn::RebindMask(D(), hn::Or(none_negative, none_positive));
  }
}

/// Fills triangles of which a vector holds one in every lane; those of more than two pixels along a
/// side one by one.
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
    small_.size = several_.size = pixels_.size = large_.size = 0;
    sort_by_size(begin, end);
    test_first_pixels();
    test_other_pixels();
    for (std::size_t i = 0; i < pixels_.size; ++i) {
      const std::uint32_t p = pixels_.words[i];
      result_.mask.set(static_cast<int>(p & 0xffff), static_cast<int>(p >> 16));
    }
    for (std::size_t i = 0; i < large_.size; ++i) fill_large(triangles_[large_.words[i]]);
    result_.large.insert(result_.large.end(), large_.words, large_.words + large_.size);
  }

  TriangleFill result() && { return std::move(result_); }

 private:
  /// Those that hold no pixel centre stay behind, the small ones go to the next stage.
  void sort_by_size(std::size_t begin, std::size_t end) {
    const D d;
    const U32 beyond_one = hn::Set(d, 0xfffefffe);
    for (std::size_t at = begin; at < end; at += hn::Lanes(d)) {
      // In the last vector some triangles are taken again.
      const std::size_t i = std::min(at, triangles_.size() - hn::Lanes(d));
      const Corners t = corners(triangles_[i].data());
      const U32 extent = boxes_of(t, shift_).extent;
      small_.push(Choice(hn::Eq(hn::And(extent, beyond_one), hn::Zero(d))), t);
      const auto not_negative = hn::Max(hn::BitCast(Half(), extent), hn::Zero(Half()));
      const auto is_large = hn::Ne(hn::And(hn::BitCast(d, not_negative), beyond_one), hn::Zero(d));
      if (!hn::AllFalse(d, is_large))
        large_.push(Choice(is_large), hn::Iota(d, static_cast<std::uint32_t>(i)));
    }
  }

  Corners corners(const std::uint32_t* triangles) const {
    const D d;
    U32 a, b, c;
    hn::LoadInterleaved3(d, triangles, a, b, c);
    const auto point = [&](U32 i) {
      return hn::GatherIndex(d, points_.packed(), hn::BitCast(Int(), i));
    };
    return {point(a), point(b), point(c)};
  }

  void test_first_pixels() {
    const D d;
    for (std::size_t i = 0; i < small_.size; i += hn::Lanes(d)) {
      const auto is_there = hn::FirstN(d, small_.size - i);
      const Corners t = small_[i];
      const Boxes box = boxes_of(t, shift_);
      const Edges edges = edges_at(t, box.low, shift_);
      pixels_.push(Choice(hn::And(is_there, is_inside<kFacing>(edges.value))), box.low);
      several_.push(Choice(hn::And(is_there, hn::Ne(box.extent, hn::Zero(d)))), t);
    }
  }

  void test_other_pixels() {
    const D d;
    const U32 right = hn::Set(d, 1), up = hn::Set(d, 1 << 16);
    for (std::size_t i = 0; i < several_.size; i += hn::Lanes(d)) {
      const auto is_there = hn::FirstN(d, several_.size - i);
      const Corners t = several_[i];
      const Boxes box = boxes_of(t, shift_);
      const Edges e = edges_at(t, box.low, shift_);
      const auto test = [&](U32 step, const Three<I32>& value) {
        const auto in_box = hn::Eq(hn::And(box.extent, step), step);
        pixels_.push(Choice(hn::And(hn::And(is_there, in_box), is_inside<kFacing>(value))),
                     hn::Add(box.low, step));
      };
      const Three<I32> above = sum(e.value, e.up);
      test(right, sum(e.value, e.right));
      test(up, above);
      test(hn::Add(right, up), sum(above, e.right));
    }
  }

  void fill_large(const Triangle& corners) {
    LatticeTriangle t(points_, corners, shift_);
    if (t.misses_all_centres()) return;
    if (kFacing == Facing::CounterClockwise && t.twice_area() < 0) return;
    t.orient();
    fill_exactly(result_.mask, t, shift_);
  }

  const SnappedPoints& points_;
  std::span<const Triangle> triangles_;
  int shift_;
  TriangleFill result_;
  Queue small_, several_;
  Words<4 * kBlock> pixels_;
  Words<kBlock> large_;
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
    TriangleFill result = fill_on_target(points, repeated, facing, resolution);
    std::erase_if(result.large, [&](std::uint32_t i) { return i >= triangles.size(); });
    return result;
  }
  return facing == Facing::Both
             ? fill_blocks<Facing::Both>(points, triangles, resolution)
             : fill_blocks<Facing::CounterClockwise>(points, triangles, resolution);
}

#endif

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
  return HWY_DYNAMIC_DISPATCH(fill_on_target)(points, triangles, facing, resolution);
}

BitImage fill_triangles(const SnappedPoints& points, std::span<const Triangle> triangles,
                        int resolution) {
  return fill(points, triangles, Facing::Both, resolution).mask;
}

}  // namespace marrow
#endif
