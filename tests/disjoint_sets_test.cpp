#include <marrow/disjoint_sets.hpp>

#include <set>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

TEST_CASE("numbers are alone until they are joined", "[disjoint_sets]") {
  DisjointSets sets(3);
  CHECK(sets.size() == 3);
  CHECK(sets.count() == 3);
  for (std::uint32_t i = 0; i < 3; ++i) CHECK(sets.root(i) == i);
  CHECK(DisjointSets(0).count() == 0);
}

TEST_CASE("the root is the lowest number of what was joined, in any order", "[disjoint_sets]") {
  constexpr std::uint32_t kCount = 60;
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    DisjointSets sets(kCount);
    std::vector<std::uint32_t> lowest(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) lowest[i] = i;
    for (int k = 0; k < 40; ++k) {
      const std::uint32_t a = random.below(kCount), b = random.below(kCount);
      const std::uint32_t low = std::min(lowest[a], lowest[b]),
                          high = std::max(lowest[a], lowest[b]);
      CHECK(sets.join(a, b) == (low != high));
      for (auto& l : lowest)
        if (l == high) l = low;
    }
    for (std::uint32_t i = 0; i < kCount; ++i) CHECK(sets.root(i) == lowest[i]);
    CHECK(sets.count() == std::set<std::uint32_t>(lowest.begin(), lowest.end()).size());
  }
}
