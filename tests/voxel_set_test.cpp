#include <marrow/voxel_set.hpp>

#include <rank_queue_detail.hpp>
#include <voxel_parts_detail.hpp>

#include <algorithm>
#include <set>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Rows of one, one full and three words.
const VoxelGrid kGrids[] = {
    {{0, 0, 0}, 1, 9, 7, 5}, {{0, 0, 0}, 1, 64, 5, 4}, {{0, 0, 0}, 1, 130, 4, 5}};

std::vector<std::uint32_t> random_voxels(const VoxelGrid& grid, Random& random,
                                         std::uint32_t percent) {
  std::vector<std::uint32_t> voxels;
  for (std::uint32_t v = 0; v < grid.count(); ++v)
    if (random.below(100) < percent) voxels.push_back(v);
  return voxels;
}

VoxelSet set_of(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels) {
  VoxelSet set(grid);
  for (const auto v : voxels) set.insert(v);
  return set;
}

bool are_neighbours(const VoxelGrid& g, std::uint32_t a, std::uint32_t b) {
  return a != b && std::abs(g.x_of(a) - g.x_of(b)) <= 1 && std::abs(g.y_of(a) - g.y_of(b)) <= 1 &&
         std::abs(g.z_of(a) - g.z_of(b)) <= 1;
}

}  // namespace

TEST_CASE("a voxel set holds what is put in, in order", "[voxel_set]") {
  Random random(1);
  for (const VoxelGrid& grid : kGrids) {
    const auto voxels = random_voxels(grid, random, 40);
    VoxelSet set = set_of(grid, voxels);
    CHECK(count(set) == voxels.size());
    std::vector<std::uint32_t> seen;
    set.for_each([&](std::uint32_t v) { seen.push_back(v); });
    CHECK(seen == voxels);
    for (std::uint32_t v = 0; v < grid.count(); ++v)
      if (set[v] != std::binary_search(voxels.begin(), voxels.end(), v)) FAIL("voxel " << v);
    for (const auto v : voxels) set.erase(v);
    CHECK(set == VoxelSet(grid));
  }
  CHECK(count(VoxelSet()) == 0);
}

TEST_CASE("runs of voxels are as long as can be", "[voxel_set]") {
  Random random(2);
  for (const VoxelGrid& grid : kGrids)
    for (const std::uint32_t percent : {0u, 5u, 60u, 97u, 100u}) {
      const VoxelSet set = set_of(grid, random_voxels(grid, random, percent));
      VoxelSet rest = set;
      std::size_t runs = 0, starts = 0;
      for (const VoxelRun& run : voxel_runs(set)) {
        ++runs;
        const std::uint32_t row = run.row * static_cast<std::uint32_t>(grid.nx);
        for (int x = run.first; x < run.end; ++x) CHECK(set[row + static_cast<std::uint32_t>(x)]);
        erase(rest, run);
      }
      for (std::uint32_t v = 0; v < grid.count(); ++v)
        starts += set[v] && (grid.x_of(v) == 0 || !set[v - 1]);
      CHECK(runs == starts);
      CHECK(rest == VoxelSet(grid));
    }
}

TEST_CASE("parts are what neighbours connect", "[voxel_set]") {
  Random random(3);
  for (const VoxelGrid& grid : kGrids)
    for (const std::uint32_t percent : {3u, 8u, 12u, 50u}) {
      auto voxels = random_voxels(grid, random, percent);
      const auto parts = voxel_parts(grid, set_of(grid, voxels));
      std::vector<std::vector<std::uint32_t>> expected;
      while (!voxels.empty()) {
        std::vector<std::uint32_t> part{voxels.front()};
        voxels.erase(voxels.begin());
        for (std::size_t k = 0; k < part.size(); ++k)
          for (std::size_t i = voxels.size(); i-- > 0;)
            if (are_neighbours(grid, part[k], voxels[i])) {
              part.push_back(voxels[i]);
              voxels.erase(voxels.begin() + static_cast<std::ptrdiff_t>(i));
            }
        std::sort(part.begin(), part.end());
        expected.push_back(part);
      }
      CHECK(parts == expected);
    }
}

TEST_CASE("pairs of neighbours in a list of voxels", "[voxel_set]") {
  Random random(4);
  for (const VoxelGrid& grid : kGrids)
    for (const std::uint32_t percent : {2u, 15u, 80u}) {
      const auto voxels = random_voxels(grid, random, percent);
      std::vector<CurveSkeleton::Edge> expected;
      for (std::uint32_t i = 0; i < voxels.size(); ++i)
        for (std::uint32_t j = i + 1; j < voxels.size(); ++j)
          if (are_neighbours(grid, voxels[i], voxels[j])) expected.push_back({i, j});
      CHECK(neighbour_pairs(grid, voxels) == expected);
    }
}

TEST_CASE("the least rank comes first", "[voxel_set]") {
  Random random(5);
  constexpr std::uint32_t kRanks = 20000;
  RankQueue queue(kRanks);
  std::set<std::uint32_t> expected;
  for (int i = 0; i < 30000; ++i) {
    if (random.below(5) < (i % 8000 < 4000 ? 3u : 2u)) {
      const std::uint32_t rank = random.below(kRanks);  // also one that is in already
      queue.push(rank);
      expected.insert(rank);
    } else if (!queue.empty()) {
      REQUIRE(queue.pop() == *expected.begin());
      expected.erase(expected.begin());
    }
    REQUIRE(queue.empty() == expected.empty());
  }
}
