// What packs some lanes of a vector together where there is no instruction for it.
#pragma once

#include <array>
#include <cstdint>

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
