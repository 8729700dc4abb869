#include <vector>

#include "closure_detail.hpp"
#include "position_hash_detail.hpp"

namespace marrow {

Closure closure_of(const Shape& shape) {
  std::vector<std::uint64_t> hash(shape.points.size());
  for (std::size_t i = 0; i < hash.size(); ++i) hash[i] = position_hash(shape.points[i]);
  std::uint64_t parity = 0, sum = 0;
  const auto add = [&](std::uint64_t a, std::uint64_t b) {
    const std::uint64_t edge = a == b ? 0 : folded_product(a, b);
    parity ^= edge;
    sum += a < b ? edge : -edge;
  };
  for (const auto& t : shape.triangles) {
    const std::uint64_t a = hash[t[0]], b = hash[t[1]], c = hash[t[2]];
    add(a, b);
    add(b, c);
    add(c, a);
  }
  return {parity == 0, parity == 0 && sum == 0};
}

}  // namespace marrow
