// Numbers that are the same on every machine.
#pragma once

#include <marrow/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace marrow::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// 0 to n - 1.
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state_ >> 33) % n);
  }
  /// [0, 1).
  double unit() { return below(1u << 30) * 0x1p-30; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// In the cube [-1, 1).
  Vec3 vector() {
    const double x = between(-1, 1), y = between(-1, 1);
    return {x, y, between(-1, 1)};
  }
  /// A direction, and a turn about it.
  Frame frame() {
    Vec3 z = vector(), a = vector();
    while (squared_length(cross(a, z)) < 0.01) z = vector(), a = vector();
    z = normalized(z);
    const Vec3 x = normalized(cross(a, z));
    return {x, cross(z, x), z};
  }

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace marrow::test
