// The set of pixels that thinning works on.
#pragma once

#include <marrow/distance_transform.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// The pixels of a silhouette that are still there, and which of them may go: all but the centres
/// of maximal discs are loose.
///
/// 30 pixels of a row share a 64-bit word: the lower half holds a bit for each that is in the set,
/// the upper half one for each that is loose. The outermost bits of both halves repeat the pixels
/// next to the word, so that what is around a pixel stands in three words.
class ShrinkingSet {
 public:
  /// Number of a pixel: 32 times its word plus its bit. Grows along rows and from row to row.
  using Pixel = std::uint32_t;

  /// Becomes the support of `map`, where no distance is over 0x7fff.
  void assign(const DistanceMap& map);

  int x_of(Pixel p) const {
    return left_ + static_cast<int>(p / 32 % words_per_row_) * kPixels + static_cast<int>(p % 32) -
           1;
  }
  int y_of(Pixel p) const { return top_ + static_cast<int>(p / 32 / words_per_row_) - 1; }
  ChamferDistance distance(Pixel p) const { return distance_[p + kMargin]; }

  bool contains(Pixel p) const { return (words_[p / 32] >> p % 32 & 1) != 0; }

  /// The pixels around `p`: bit 3 * (dy + 1) + dx + 1 for the one at (dx, dy). The lower half says
  /// which are in the set, the upper which are loose.
  std::uint64_t around(Pixel p) const {
    constexpr std::uint64_t kThree = 0x0000000700000007;
    const std::uint64_t* word = &words_[p / 32];
    const unsigned shift = p % 32 - 1;
    return (word[-words_per_row_] >> shift & kThree) | (word[0] >> shift & kThree) << 3 |
           (word[words_per_row_] >> shift & kThree) << 6;
  }
  /// Which of the eight around `p` have no greater distance, as the same bits.
  unsigned not_deeper(Pixel p) const { return not_deeper_[p]; }

  /// The pixel at a bit of what is around `p`.
  Pixel neighbour(Pixel p, unsigned bit) const {
    const Pixel n = p + step_[bit];
    if ((n + 1) % 32 > 1) [[likely]]
      return n;
    return n % 32 == 0 ? n - 2 : n + 2;  // over the bits that only repeat
  }

  void remove(Pixel p) {
    std::uint64_t* word = &words_[p / 32];
    constexpr std::uint64_t kBoth = 0x0000000100000001;
    *word &= ~(kBoth << p % 32);
    if (p % 32 == 1)
      word[-1] &= ~(kBoth << 31);
    else if (p % 32 == kPixels)
      word[1] &= ~kBoth;
  }

  /// A bit for every pixel of word `i` that is in the set, or that is loose; bit 0 is pixel 32 * i.
  std::uint32_t in_word(std::size_t i) const {
    return static_cast<std::uint32_t>(words_[i]) & kOwn;
  }
  std::uint32_t loose_in_word(std::size_t i) const {
    return static_cast<std::uint32_t>(words_[i] >> 32) & kOwn;
  }
  std::size_t word_count() const { return words_.size(); }
  ChamferDistance greatest_distance() const { return greatest_distance_; }

  /// For work on whole words, which must leave the outermost bits right.
  std::span<std::uint64_t> words() { return words_; }
  std::span<const std::uint64_t> words() const { return words_; }
  std::ptrdiff_t words_per_row() const { return words_per_row_; }
  /// Those of bits 0 to 31 of word `i`; rows of words are 32 * words_per_row() apart.
  const ChamferDistance* distances_of_word(std::size_t i) const {
    return &distance_[kMargin] + 32 * i;
  }

 private:
  static constexpr int kPixels = 30;
  static constexpr Pixel kMargin = 32;  // what is around the first and last words is looked at too
  static constexpr std::uint32_t kOwn = 0x7ffffffe;

  int left_ = 0, top_ = 0;
  std::ptrdiff_t words_per_row_ = 0;
  ChamferDistance greatest_distance_ = 0;
  std::array<Pixel, 9> step_;  // modulo 2^32
  std::vector<std::uint64_t> words_;
  std::vector<ChamferDistance> distance_;  // of pixel p at p + kMargin
  std::vector<std::uint16_t> not_deeper_;
};

/// All pixels of `set` by number.
std::vector<ShrinkingSet::Pixel> pixels(const ShrinkingSet& set);

}  // namespace marrow
