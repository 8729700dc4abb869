// Disjoint sets of numbers, for connected parts of anything.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace marrow {

/// The numbers below `size`, each in a set of its own until sets are joined. The root of a set is
/// its lowest number, whatever the order of the joins.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : up_(size), count_(size) {
    std::iota(up_.begin(), up_.end(), 0u);
  }

  std::uint32_t root(std::uint32_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  /// Whether they were in different sets.
  bool join(std::uint32_t i, std::uint32_t j) {
    i = root(i), j = root(j);
    if (i == j) return false;
    up_[std::max(i, j)] = std::min(i, j);
    --count_;
    return true;
  }
  std::size_t size() const { return up_.size(); }
  /// Number of sets.
  std::size_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> up_;
  std::size_t count_;
};

}  // namespace marrow
