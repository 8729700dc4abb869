// A priority queue of ranks.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marrow {

/// A set of the numbers 0 to n - 1 that gives the least first: one bit for each, and one for every
/// word of these that is not empty.
class RankQueue {
 public:
  explicit RankQueue(std::size_t n) : bits_(n / 64 + 1, 0), used_(n / 4096 + 1, 0) {}

  bool empty() const { return size_ == 0; }

  void push(std::uint32_t rank) {
    const std::size_t word = rank / 64, group = rank / 4096;
    const std::uint64_t bit = std::uint64_t{1} << rank % 64;
    size_ += (bits_[word] & bit) == 0;
    bits_[word] |= bit;
    used_[group] |= std::uint64_t{1} << word % 64;
    if (group < first_) first_ = group;
  }

  /// Takes the least rank out of a queue that is not empty.
  std::uint32_t pop() {
    while (used_[first_] == 0) ++first_;
    std::uint64_t& used = used_[first_];
    const std::size_t word = 64 * first_ + static_cast<std::size_t>(std::countr_zero(used));
    std::uint64_t& bits = bits_[word];
    const auto rank =
        static_cast<std::uint32_t>(64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
    bits &= bits - 1;
    if (bits == 0) used &= used - 1;
    --size_;
    return rank;
  }

 private:
  std::vector<std::uint64_t> bits_, used_;
  std::size_t first_ = 0;  // all groups before it are empty
  std::size_t size_ = 0;
};

}  // namespace marrow
