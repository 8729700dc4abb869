// Simple points of a voxel set: those whose removal changes no topology.
#pragma once

#include <array>
#include <cstdint>

namespace marrow {

/// A voxel and its 26 neighbours as bits: bit i is (i % 3 - 1, 1 - i / 3 % 3, 1 - i / 9) from the
/// voxel. What bit 13 says, the voxel itself, plays no part.
using Neighbourhood = std::uint32_t;

inline constexpr Neighbourhood kCentre = 1u << 13;

/// Whether a voxel with these neighbours is simple: 26-connectivity for the set, 6 for the rest
/// (Bertrand and Malandain 1994).
bool is_simple(Neighbourhood neighbours);

/// is_simple() with a memory: few neighbourhoods make up most of a shape.
class SimplePoints {
 public:
  SimplePoints() { known_.fill(kCentre); }

  bool operator()(Neighbourhood neighbours) {
    const Neighbourhood n = neighbours & ~kCentre;
    std::uint32_t& known = known_[n * 0x9e3779b1u >> (32 - kBits)];
    if ((known & ~kSimple) != n) known = n | (is_simple(n) ? kSimple : 0);
    return (known & kSimple) != 0;
  }

 private:
  static constexpr int kBits = 12;
  static constexpr std::uint32_t kSimple = 1u << 31;

  std::array<std::uint32_t, std::size_t{1} << kBits> known_;  // kCentre: nothing yet
};

}  // namespace marrow
