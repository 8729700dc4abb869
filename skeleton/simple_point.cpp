#include <array>
#include <bit>

#include "simple_point_detail.hpp"

namespace marrow {

namespace {

/// The neighbours at offsets whose coordinate on an axis (stride 1, 3 or 9) is -1, 0 or 1.
constexpr Neighbourhood slice(int stride, int coordinate) {
  Neighbourhood bits = 0;
  for (int i = 0; i < 27; ++i)
    if (i / stride % 3 == coordinate + 1) bits |= Neighbourhood{1} << i;
  return bits;
}

constexpr Neighbourhood kNotLowX = ~slice(1, -1), kNotHighX = ~slice(1, 1),
                        kNotLowY = ~slice(3, -1), kNotHighY = ~slice(3, 1),
                        kNotLowZ = ~slice(9, -1), kNotHighZ = ~slice(9, 1);

/// The neighbours that differ from the voxel in at most `most` coordinates, without the voxel.
constexpr Neighbourhood ring(int most) {
  Neighbourhood bits = 0;
  for (int i = 0; i < 27; ++i)
    if (i != 13 && (i % 3 != 1) + (i / 3 % 3 != 1) + (i / 9 != 1) <= most)
      bits |= Neighbourhood{1} << i;
  return bits;
}

constexpr Neighbourhood kFaces = ring(1), kFacesAndEdges = ring(2), kAll = ring(3);

constexpr Neighbourhood beside_x(Neighbourhood n) {
  return (n & kNotHighX) << 1 | (n & kNotLowX) >> 1;
}
constexpr Neighbourhood beside_y(Neighbourhood n) {
  return (n & kNotHighY) << 3 | (n & kNotLowY) >> 3;
}
constexpr Neighbourhood beside_z(Neighbourhood n) {
  return (n & kNotHighZ) << 9 | (n & kNotLowZ) >> 9;
}

struct By26 {
  constexpr Neighbourhood operator()(Neighbourhood n) const {
    n |= beside_x(n);
    n |= beside_y(n);
    return n | beside_z(n);
  }
};
struct By6 {
  constexpr Neighbourhood operator()(Neighbourhood n) const {
    return n | beside_x(n) | beside_y(n) | beside_z(n);
  }
};

/// What a single bit grows to.
template <class Grow>
constexpr std::array<Neighbourhood, 27> grown_bits() {
  std::array<Neighbourhood, 27> table{};
  for (std::size_t i = 0; i < 27; ++i) table[i] = Grow{}(Neighbourhood{1} << i);
  return table;
}

/// Whether all of `targets`, which lie in `set`, are connected in it. Two steps nearly always
/// decide; a loop from the start would make the processor guess how many.
template <class Grow>
bool are_connected(Neighbourhood targets, Neighbourhood set) {
  static constexpr auto kGrown = grown_bits<Grow>();
  Neighbourhood part = kGrown[static_cast<std::size_t>(std::countr_zero(targets))] & set;
  part = Grow{}(part)&set;
  while ((part & targets) != targets) {
    const Neighbourhood next = Grow{}(part)&set;
    if (next == part) return false;
    part = next;
  }
  return true;
}

}  // namespace

bool is_simple(Neighbourhood neighbours) {
  const Neighbourhood set = neighbours & kAll, open_faces = ~neighbours & kFaces;
  return set != 0 && open_faces != 0 &&
         are_connected<By6>(open_faces, ~neighbours & kFacesAndEdges) &&
         are_connected<By26>(set, set);
}

}  // namespace marrow
