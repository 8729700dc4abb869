// Triangles in vectors, one in every lane, by the packed places of their corners. To be included
// after foreach_target.h, once for every instruction set.
#if defined(MARROW_PACKED_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MARROW_PACKED_INL_HPP
#undef MARROW_PACKED_INL_HPP
#else
#define MARROW_PACKED_INL_HPP
#endif

#include <hwy/highway.h>

#include "pack_table_detail.hpp"

// Highway 1.0 packs vectors of AVX2 and SSE by a table that GCC copies every time.
#undef MARROW_PACK_BY_TABLE
#define MARROW_PACK_BY_TABLE (HWY_ARCH_X86 && HWY_TARGET > HWY_AVX3)

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<std::uint32_t>;  // a point in each lane, packed
using Int = hn::RebindToSigned<D>;
using U32 = hn::Vec<D>;
using I32 = hn::Vec<Int>;

constexpr std::size_t kSlack = hn::MaxLanes(D());  // whole vectors are written

/// One value of every triangle of a vector for each corner, or each edge from a corner to the next.
template <class V>
struct Three {
  V a, b, c;
};

using Corners = Three<U32>;

// Of both coordinates the least and the greatest at the corners.
#if HWY_TARGET == HWY_SCALAR  // whose words cannot be seen as vectors of halves

HWY_INLINE U32 join(U32 upper, U32 lower) {
  return hn::Or(hn::And(upper, hn::Set(D(), 0xffff0000)), lower);
}
HWY_INLINE Corners lower_halves(const Corners& t) {
  const U32 mask = hn::Set(D(), 0xffff);
  return {hn::And(t.a, mask), hn::And(t.b, mask), hn::And(t.c, mask)};
}
HWY_INLINE U32 least(const Corners& t) {
  const Corners x = lower_halves(t);
  return join(hn::Min(hn::Min(t.a, t.b), t.c), hn::Min(hn::Min(x.a, x.b), x.c));
}
HWY_INLINE U32 greatest(const Corners& t) {
  const Corners x = lower_halves(t);
  return join(hn::Max(hn::Max(t.a, t.b), t.c), hn::Max(hn::Max(x.a, x.b), x.c));
}

#else

using Half = hn::Repartition<std::int16_t, D>;
HWY_INLINE U32 least(const Corners& t) {
  const Half h;
  return hn::BitCast(
      D(), hn::Min(hn::Min(hn::BitCast(h, t.a), hn::BitCast(h, t.b)), hn::BitCast(h, t.c)));
}
HWY_INLINE U32 greatest(const Corners& t) {
  const Half h;
  return hn::BitCast(
      D(), hn::Max(hn::Max(hn::BitCast(h, t.a), hn::BitCast(h, t.b)), hn::BitCast(h, t.c)));
}

#endif

HWY_INLINE U32 in_both_halves(std::uint32_t value) { return hn::Set(D(), value << 16 | value); }

// Coordinates of 15 bits leave room to add to both halves of a word at once.
HWY_INLINE U32 shift_both(U32 v, int shift) {
  return hn::And(hn::ShiftRightSame(v, shift), in_both_halves(0xffffu >> shift));
}

/// Some lanes of a vector, to be packed together.
class Choice {
 public:
  explicit HWY_INLINE Choice(hn::Mask<D> mask) : mask_(mask), size_(hn::CountTrue(D(), mask)) {
#if MARROW_PACK_BY_TABLE
    const D d;
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    const hn::Rebind<std::uint8_t, D> bytes;
    lanes_ = hn::IndicesFromVec(d, hn::PromoteTo(d, hn::LoadU(bytes, kPackTable[bits[0]].data())));
#endif
  }

  HWY_INLINE std::size_t size() const { return size_; }
  /// Writes a whole vector, of which size() lanes matter.
  HWY_INLINE void store(U32 v, std::uint32_t* to) const {
#if MARROW_PACK_BY_TABLE
    hn::StoreU(hn::TableLookupLanes(v, lanes_), D(), to);
#else
    hn::StoreU(hn::Compress(v, mask_), D(), to);
#endif
  }

 private:
  hn::Mask<D> mask_;
  std::size_t size_;
#if MARROW_PACK_BY_TABLE
  decltype(hn::IndicesFromVec(D(), U32())) lanes_;
#endif
};

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
