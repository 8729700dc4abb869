// A set of voxels of a grid, one bit each.
#pragma once

#include <marrow/vote_grid.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// Voxels of a grid in rows along x: bit x % 64 of word x / 64 of a row; the row of y and z is
/// y + ny * z. Bits past the end of a row are zero. The order of the bits is that of the indices.
class VoxelSet {
 public:
  using Word = std::uint64_t;

  VoxelSet() = default;
  /// The empty set.
  explicit VoxelSet(const VoxelGrid& grid);

  bool operator[](std::uint32_t voxel) const { return bits_[word_of(voxel)] >> bit_of(voxel) & 1; }
  void insert(std::uint32_t voxel) { bits_[word_of(voxel)] |= Word{1} << bit_of(voxel); }
  void erase(std::uint32_t voxel) { bits_[word_of(voxel)] &= ~(Word{1} << bit_of(voxel)); }

  std::size_t words_per_row() const { return words_; }
  std::size_t rows_per_layer() const { return ny_; }
  std::size_t rows() const { return words_ == 0 ? 0 : bits_.size() / words_; }
  Word* row(std::size_t r) { return bits_.data() + r * words_; }
  const Word* row(std::size_t r) const { return bits_.data() + r * words_; }
  std::span<const Word> words() const { return bits_; }

  /// Calls visit(voxel of its bit 0, word) for every word, in their order.
  template <class Visit>
  void for_each_word(Visit visit) const {
    for (std::size_t r = 0; r < rows(); ++r)
      for (std::size_t w = 0; w < words_; ++w)
        visit(static_cast<std::uint32_t>(r * nx_ + 64 * w), row(r)[w]);
  }

  /// Calls visit(voxel) for every voxel of the set, lowest index first.
  template <class Visit>
  void for_each(Visit visit) const {
    for_each_word([&](std::uint32_t first, Word left) {
      for (; left != 0; left &= left - 1)
        visit(first + static_cast<std::uint32_t>(std::countr_zero(left)));
    });
  }

  friend bool operator==(const VoxelSet&, const VoxelSet&) = default;

 private:
  std::size_t word_of(std::uint32_t voxel) const { return voxel / nx_ * words_ + voxel % nx_ / 64; }
  std::uint32_t bit_of(std::uint32_t voxel) const { return voxel % nx_ % 64; }

  std::uint32_t nx_ = 1, ny_ = 0;
  std::size_t words_ = 0;  // of a row
  std::vector<Word> bits_;
};

/// Number of voxels in the set.
std::size_t count(const VoxelSet& set);

}  // namespace marrow
