// Rows of a volume as words of 64 voxels, and those around them.
#pragma once

#include <marrow/volume.hpp>

#include <span>
#include <vector>

namespace marrow::volume_detail {

using Word = Volume::Word;
using Row = std::span<const Word>;

/// In bit x of word `i` the voxel x - 1 of the row.
inline Word shifted_up(Row row, std::size_t i) {
  return row[i] << 1 | (i > 0 ? row[i - 1] >> 63 : 0);
}

/// In bit x of word `i` the voxel x + 1 of the row.
inline Word shifted_down(Row row, std::size_t i) {
  return row[i] >> 1 | (i + 1 < row.size() ? row[i + 1] << 63 : 0);
}

/// The rows of a volume; what lies outside it is background.
class Rows {
 public:
  explicit Rows(const Volume& volume) : volume_(volume), nothing_(volume.words_per_row(), 0) {}

  Row operator()(int y, int z) const {
    const bool is_there = y >= 0 && z >= 0 && y < volume_.ny && z < volume_.nz;
    return is_there ? volume_.row(y, z) : Row(nothing_);
  }

 private:
  const Volume& volume_;
  std::vector<Word> nothing_;
};

}  // namespace marrow::volume_detail
