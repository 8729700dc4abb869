#include "dual_cell.hpp"

#include <algorithm>

namespace marrow {
namespace {

/// Corners of a face in cyclic order.
std::array<int, 4> face_corners(int axis, int side) {
  const int u = 1 << (axis + 1) % 3;
  const int v = 1 << (axis + 2) % 3;
  const int base = side << axis;
  return {base, base | u, base | u | v, base | v};
}

struct Face {
  std::array<int, 4> edges;
  std::array<bool, 4> inside;  ///< corner i lies between edges i - 1 and i

  int crossings() const {
    int count = 0;
    for (std::size_t i = 0; i < 4; ++i) count += inside[i] != inside[(i + 1) % 4];
    return count;
  }
};

Face face_of(int mask, int axis, int side) {
  const std::array<int, 4> corners = face_corners(axis, side);
  Face face{};
  for (std::size_t i = 0; i < 4; ++i) {
    face.edges[i] = cell_edge(corners[i], corners[(i + 1) % 4]);
    face.inside[i] = (mask >> corners[i] & 1) != 0;
  }
  return face;
}

void join(std::array<int, 12>& label, int a, int b) {
  const int from = std::max(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
  const int to = std::min(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
  std::replace(label.begin(), label.end(), from, to);
}

void join_across(std::array<int, 12>& label, const Face& face) {
  const bool is_ambiguous = face.crossings() == 4;
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_ambiguous && face.inside[i]) join(label, face.edges[(i + 3) % 4], face.edges[i]);
    if (is_ambiguous || face.inside[i] == face.inside[(i + 1) % 4]) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (face.inside[j] != face.inside[(j + 1) % 4]) join(label, face.edges[j], face.edges[i]);
    }
  }
}

CellSheets sheets_of(int mask) {
  std::array<int, 12> label{};
  for (int e = 0; e < 12; ++e) label[static_cast<std::size_t>(e)] = e;
  std::array<bool, 12> is_crossed{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Face face = face_of(mask, axis, side);
      for (std::size_t i = 0; i < 4; ++i) {
        if (face.inside[i] == face.inside[(i + 1) % 4]) continue;
        is_crossed[static_cast<std::size_t>(face.edges[i])] = true;
      }
      join_across(label, face);
    }
  }
  CellSheets sheets;
  sheets.sheet_of_edge.fill(-1);
  for (std::size_t e = 0; e < 12; ++e) {
    if (!is_crossed[e]) continue;
    const auto first = static_cast<std::size_t>(label[e]);
    sheets.sheet_of_edge[e] =
        first == e ? static_cast<std::int8_t>(sheets.count++) : sheets.sheet_of_edge[first];
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Face face = face_of(mask, axis, side);
      const auto sheet = [&](std::size_t i) {
        return sheets.sheet_of_edge[static_cast<std::size_t>(face.edges[i])];
      };
      const bool is_one = sheet(0) == sheet(1) && sheet(1) == sheet(2) && sheet(2) == sheet(3);
      if (face.crossings() == 4 && is_one) {
        sheets.doubled_faces |= static_cast<std::uint8_t>(1 << (2 * axis + side));
      }
    }
  }
  return sheets;
}

}  // namespace

const std::array<CellSheets, 256>& cell_sheets() {
  static const std::array<CellSheets, 256> table = [] {
    std::array<CellSheets, 256> all;
    for (int mask = 0; mask < 256; ++mask) all[static_cast<std::size_t>(mask)] = sheets_of(mask);
    return all;
  }();
  return table;
}

}  // namespace marrow
