#include <array>
#include <bit>

#include "simple_point_detail.hpp"

namespace marrow {

namespace {

struct Offset {
  int x, y, z;
};

constexpr Offset offset_of(int bit) {
  const int i = bit < 13 ? bit : bit + 1;
  return {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
}

constexpr int absolute(int v) { return v < 0 ? -v : v; }
constexpr int steps(const Offset& o) { return absolute(o.x) + absolute(o.y) + absolute(o.z); }

constexpr Neighbourhood ring(int greatest_steps) {
  Neighbourhood mask = 0;
  for (int i = 0; i < 26; ++i)
    if (steps(offset_of(i)) <= greatest_steps) mask |= Neighbourhood{1} << i;
  return mask;
}

constexpr Neighbourhood kFaces = ring(1), kFacesAndEdges = ring(2), kAll = ring(3);

/// For every neighbour, those adjacent to it: by 26-adjacency, or by 6-adjacency.
constexpr std::array<Neighbourhood, 26> adjacency(bool by_face) {
  std::array<Neighbourhood, 26> table{};
  for (int i = 0; i < 26; ++i)
    for (int j = 0; j < 26; ++j) {
      const Offset a = offset_of(i), b = offset_of(j), d{a.x - b.x, a.y - b.y, a.z - b.z};
      const bool near = absolute(d.x) <= 1 && absolute(d.y) <= 1 && absolute(d.z) <= 1;
      if (i != j && near && (!by_face || steps(d) == 1))
        table[static_cast<std::size_t>(i)] |= Neighbourhood{1} << j;
    }
  return table;
}

constexpr auto kAdjacent26 = adjacency(false);
constexpr auto kAdjacent6 = adjacency(true);

/// The part of `set` connected to its member `seed` (one bit).
Neighbourhood connected(Neighbourhood set, Neighbourhood seed,
                        const std::array<Neighbourhood, 26>& adjacent) {
  Neighbourhood part = seed, frontier = seed;
  while (frontier != 0) {
    const auto i = static_cast<std::size_t>(std::countr_zero(frontier));
    frontier &= frontier - 1;
    const Neighbourhood fresh = adjacent[i] & set & ~part;
    part |= fresh;
    frontier |= fresh;
  }
  return part;
}

Neighbourhood lowest_bit(Neighbourhood set) { return set & (~set + 1); }

}  // namespace

bool is_simple(Neighbourhood neighbours) {
  const Neighbourhood faces_open = ~neighbours & kFaces;
  if (neighbours == 0 || faces_open == 0) return false;
  if (connected(neighbours, lowest_bit(neighbours), kAdjacent26) != neighbours) return false;
  const Neighbourhood open = ~neighbours & kFacesAndEdges & kAll;
  return (connected(open, lowest_bit(faces_open), kAdjacent6) & faces_open) == faces_open;
}

}  // namespace marrow
