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

/// The bits of a coordinate; minus zero is the same place as zero.
inline std::uint64_t coordinate_bits(double c) { return std::bit_cast<std::uint64_t>(c + 0.0); }

inline std::uint64_t position_hash(const Vec3& p) {
  const std::uint64_t xy = folded_product(coordinate_bits(p.x) ^ 0x9e3779b97f4a7c15u,
                                          coordinate_bits(p.y) ^ 0xbf58476d1ce4e5b9u);
  return folded_product(xy ^ coordinate_bits(p.z), 0x94d049bb133111ebu);
}

/// By bits, so that what is not a number is the same as itself.
inline bool is_same_place(const Vec3& a, const Vec3& b) {
  return coordinate_bits(a.x) == coordinate_bits(b.x) &&
         coordinate_bits(a.y) == coordinate_bits(b.y) &&
         coordinate_bits(a.z) == coordinate_bits(b.z);
}

}  // namespace marrow
