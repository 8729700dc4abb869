// What a volume is: a regular grid of voxels, each of the shape or not.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// A box of foreground flags, one bit per voxel in rows along x, and its place in the world. Voxels
/// are closed: two that share only an edge or a corner touch (26 neighbours). What lies outside the
/// box is background.
struct Volume {
  using Word = std::uint64_t;

  int nx = 0, ny = 0, nz = 0;  ///< voxels along the axes, 1 to kLongestSide each
  std::vector<Word> bits;      ///< bit x % 64 of word x / 64 of row y + ny * z; bits past nx are 0
  Vec3 origin;                 ///< centre of voxel (0, 0, 0), in world units
  /// From the centre of a voxel to that of the next one along x, y and z: linearly independent, of
  /// any length and direction.
  std::array<Vec3, 3> steps{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  static constexpr int kLongestSide = 1 << 14;

  Volume() = default;
  /// Background only, in units of voxels.
  Volume(int x, int y, int z)
      : nx(x),
        ny(y),
        nz(z),
        bits(words_per_row() * static_cast<std::size_t>(y) * static_cast<std::size_t>(z)) {}

  std::size_t words_per_row() const { return (static_cast<std::size_t>(nx) + 63) / 64; }
  std::span<const Word> row(int y, int z) const {
    return std::span(bits).subspan(first_word(y, z), words_per_row());
  }
  std::span<Word> row(int y, int z) {
    return std::span(bits).subspan(first_word(y, z), words_per_row());
  }
  bool contains(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz;
  }
  /// Whether a voxel of the box is foreground.
  bool operator()(int x, int y, int z) const { return row(y, z)[word_of(x)] >> (x & 63) & 1; }
  void set(int x, int y, int z) { row(y, z)[word_of(x)] |= Word{1} << (x & 63); }

  /// World coordinates of a place in units of voxels; the centre of voxel (x, y, z) is (x, y, z).
  Vec3 to_world(const Vec3& p) const {
    return origin + steps[0] * p.x + steps[1] * p.y + steps[2] * p.z;
  }

  friend bool operator==(const Volume&, const Volume&) = default;

 private:
  static std::size_t word_of(int x) { return static_cast<std::size_t>(x) >> 6; }
  std::size_t first_word(int y, int z) const {
    return words_per_row() * (static_cast<std::size_t>(y) +
                              static_cast<std::size_t>(ny) * static_cast<std::size_t>(z));
  }
};

}  // namespace marrow
