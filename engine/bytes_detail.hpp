// Numbers of binary files, of either byte order.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace marrow::bytes_detail {

template <std::size_t size>
struct UnsignedOf;
template <>
struct UnsignedOf<1> {
  using Type = std::uint8_t;
};
template <>
struct UnsignedOf<2> {
  using Type = std::uint16_t;
};
template <>
struct UnsignedOf<4> {
  using Type = std::uint32_t;
};
template <>
struct UnsignedOf<8> {
  using Type = std::uint64_t;
};

inline std::uint8_t reversed(std::uint8_t v) { return v; }
inline std::uint16_t reversed(std::uint16_t v) { return __builtin_bswap16(v); }
inline std::uint32_t reversed(std::uint32_t v) { return __builtin_bswap32(v); }
inline std::uint64_t reversed(std::uint64_t v) { return __builtin_bswap64(v); }

/// The number whose bytes begin at `at`.
template <class Number, std::endian order>
Number load(const char* at) {
  typename UnsignedOf<sizeof(Number)>::Type bits;
  std::memcpy(&bits, at, sizeof bits);
  if constexpr (order != std::endian::native) bits = reversed(bits);
  return std::bit_cast<Number>(bits);
}

/// Appends the bytes of `value`, lowest first.
template <class Number>
void append_little(std::string& bytes, Number value) {
  auto bits = std::bit_cast<typename UnsignedOf<sizeof(Number)>::Type>(value);
  if constexpr (std::endian::native != std::endian::little) bits = reversed(bits);
  char buffer[sizeof bits];
  std::memcpy(buffer, &bits, sizeof bits);
  bytes.append(buffer, sizeof buffer);
}

}  // namespace marrow::bytes_detail
