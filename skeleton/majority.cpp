// Sums of 27 bits for 64 voxels at once: bit i of a number is a word with bit i of all 64.
#include <marrow/visual_hull.hpp>

#include <array>

namespace marrow {

namespace {

using Word = VoxelSet::Word;

struct Carry {
  Word sum, carry;
};

Carry add(Word a, Word b, Word c) { return {a ^ b ^ c, (a & b) | (c & (a ^ b))}; }

using UpTo3 = std::array<Word, 2>;
using UpTo9 = std::array<Word, 4>;

/// A voxel and those beside it along x.
UpTo3 sum_along_x(const Word* row, std::size_t w, std::size_t words) {
  const Word before = w > 0 ? row[w - 1] : 0, after = w + 1 < words ? row[w + 1] : 0;
  const auto [sum, carry] = add(row[w] << 1 | before >> 63, row[w], row[w] >> 1 | after << 63);
  return {sum, carry};
}

UpTo9 sum_of(const UpTo3& a, const UpTo3& b, const UpTo3& c) {
  const auto [ones, k] = add(a[0], b[0], c[0]);
  const auto [twos, m] = add(a[1], b[1], c[1]);
  const Word n = twos & k;
  return {ones, twos ^ k, m ^ n, m & n};
}

/// Whether the sum is at least 14 (01110 in binary; 27 is the most).
Word is_majority(const UpTo9& a, const UpTo9& b, const UpTo9& c) {
  const Word k = add(a[0], b[0], c[0]).carry;
  const auto [twos, k4] = add(a[1], b[1], c[1]);
  const auto [fours, k8] = add(a[2], b[2], c[2]);
  const auto [eights, k16] = add(a[3], b[3], c[3]);
  const auto [four, l8] = add(fours, k4, twos & k);
  const auto [eight, l16] = add(eights, k8, l8);
  return k16 | l16 | (eight & four & (twos ^ k));
}

/// Sums of 3x3 voxels of one layer.
void sum_layer(const VoxelSet& set, std::size_t z, std::vector<UpTo9>& sums) {
  const std::size_t rows = set.rows_per_layer(), words = set.words_per_row();
  for (std::size_t w = 0; w < words; ++w) {
    UpTo3 before{}, here = sum_along_x(set.row(z * rows), w, words);
    for (std::size_t y = 0; y < rows; ++y) {
      const UpTo3 after = y + 1 < rows ? sum_along_x(set.row(z * rows + y + 1), w, words) : UpTo3{};
      sums[y * words + w] = sum_of(before, here, after);
      before = here;
      here = after;
    }
  }
}

}  // namespace

VoxelSet majority(const VoxelGrid& grid, const VoxelSet& set) {
  const std::size_t words = set.rows_per_layer() * set.words_per_row();
  std::vector<UpTo9> below(words), here(words), above(words);
  VoxelSet result(grid);
  const auto layers = static_cast<std::size_t>(grid.nz);
  for (std::size_t z = 0; z + 1 < layers; ++z) {
    sum_layer(set, z + 1, above);
    Word* row = result.row(z * set.rows_per_layer());
    for (std::size_t i = 0; i < words; ++i) row[i] = is_majority(below[i], here[i], above[i]);
    below.swap(here);
    here.swap(above);
  }
  return result;
}

}  // namespace marrow
