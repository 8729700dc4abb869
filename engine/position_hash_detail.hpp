// Hashes of places, for welding points that stand at the same one.
#pragma once

#include <marrow/vec.hpp>

#include <bit>
#include <cstdint>

namespace marrow {

/// High and low half of a 128-bit product, folded: a hash of two numbers of which neither is small.
inline std::uint64_t folded_product(std::uint64_t a, std::uint64_t b) {
  __extension__ using Uint128 = unsigned __int128;
  const Uint128 product = Uint128{a} * b;
  return static_cast<std::uint64_t>(product >> 64) ^ static_cast<std::uint64_t>(product);
}

/// The same for minus zero as for zero.
inline std::uint64_t position_hash(const Vec3& p) {
  const auto bits = [](double c) { return std::bit_cast<std::uint64_t>(c + 0.0); };
  const std::uint64_t xy =
      folded_product(bits(p.x) ^ 0x9e3779b97f4a7c15u, bits(p.y) ^ 0xbf58476d1ce4e5b9u);
  return folded_product(xy ^ bits(p.z), 0x94d049bb133111ebu);
}

}  // namespace marrow
