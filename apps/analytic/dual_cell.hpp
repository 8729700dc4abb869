// Which edges of a cell belong to one sheet of the surface.
#pragma once

#include <array>
#include <cstdint>

namespace marrow {

// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2 & 1).

/// Number of the edge between two neighbouring corners, 0 to 11.
constexpr int cell_edge(int corner_a, int corner_b) {
  const int axis = (corner_a ^ corner_b) >> 1;  // 1, 2, 4 -> 0, 1, 2
  const int base = corner_a & corner_b;
  return axis * 4 + (base >> (axis + 1) % 3 & 1) + 2 * (base >> (axis + 2) % 3 & 1);
}

/// The sheets in a cell whose corners inside the shape are the bits of a mask. Where the inside
/// corners of a face lie on its diagonal, the surface cuts them apart; both cells at a face say so.
struct CellSheets {
  int count = 0;
  std::array<std::int8_t, 12> sheet_of_edge{};  ///< -1: the surface does not cross it
  std::uint8_t doubled_faces = 0;  ///< bit 2 * axis + side: one sheet crosses this face twice
};

/// Sheets for every mask.
const std::array<CellSheets, 256>& cell_sheets();

}  // namespace marrow
