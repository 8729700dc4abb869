// Masks of vectors as bits. To be included after foreach_target.h, once for every instruction set.
#if defined(MARROW_MASK_BITS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MARROW_MASK_BITS_INL_HPP
#undef MARROW_MASK_BITS_INL_HPP
#else
#define MARROW_MASK_BITS_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

/// A bit for each of at most 32 lanes.
template <class Tag>
HWY_INLINE std::uint32_t bits_of(Tag d, hwy::HWY_NAMESPACE::Mask<Tag> mask) {
  static_assert(hwy::HWY_NAMESPACE::MaxLanes(Tag()) <= 32);
  std::uint8_t bytes[8] = {};
  hwy::HWY_NAMESPACE::StoreMaskBits(d, mask, bytes);
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 4; ++i) bits |= std::uint32_t{bytes[i]} << 8 * i;
  return bits;
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
