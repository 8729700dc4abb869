// Points by place: those that stand at the same one are found in constant time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "position_hash_detail.hpp"

namespace marrow {

/// A hash table from places to numbers. It keeps no coordinates: who asks says where number i is.
class PlaceTable {
 public:
  /// Room for this many places before it has to grow.
  explicit PlaceTable(std::size_t places)
      : slots_(std::bit_ceil(std::max<std::size_t>(64, 2 * places)), kEmpty) {}

  /// The number of the place of `p`, which gets the number `next` if it is new.
  /// `place_of(i)` is the place that was given the number i.
  template <class PlaceOf>
  std::uint32_t number_at(const Vec3& p, std::uint32_t next, PlaceOf place_of) {
    if (2 * used_ >= slots_.size()) grow(place_of);
    Slot& slot = find(p, place_of);
    if (slot.number != kNone) return slot.number;
    ++used_;
    slot = {tag_of(position_hash(p)), next};
    return next;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  /// Part of the hash beside the number saves most looks at places that are others.
  struct Slot {
    std::uint32_t tag, number;
  };
  static constexpr Slot kEmpty{0, kNone};

  static std::uint32_t tag_of(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 32); }

  template <class PlaceOf>
  Slot& find(const Vec3& p, PlaceOf place_of) {
    const std::uint64_t hash = position_hash(p);
    for (std::size_t i = hash;; ++i) {
      Slot& slot = slots_[i & (slots_.size() - 1)];
      if (slot.number == kNone) return slot;
      if (slot.tag == tag_of(hash) && is_same_place(place_of(slot.number), p)) return slot;
    }
  }

  template <class PlaceOf>
  void grow(PlaceOf place_of) {
    std::vector<Slot> old(2 * slots_.size(), kEmpty);
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.number != kNone) find(place_of(slot.number), place_of) = slot;
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

}  // namespace marrow
