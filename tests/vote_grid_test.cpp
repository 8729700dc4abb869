#include <marrow/vote_grid.hpp>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <span>
#include <thread>

#include "catch.hpp"
#include "random.hpp"
#include "scale.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Many in few voxels, some anywhere; at multiples of 2^-20, so that sums are exact.
std::vector<Match> random_matches(std::size_t count, const Vec3& low, const Vec3& high) {
  Random random(5);
  std::vector<Match> matches;
  const auto between = [&](double a, double b) {
    return std::ldexp(std::round(std::ldexp(random.between(a, b), 20)), -20);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double share = i % 2 == 0 ? 0.05 : 1;
    const Vec3 top = low + (high - low) * share;
    const double x = between(low.x, top.x), y = between(low.y, top.y);
    matches.push_back(
        {{x, y, between(low.z, top.z)}, static_cast<ChamferDistance>(1 + random.below(65535))});
  }
  return matches;
}

constexpr Vec3 kLow{-0.5, -1, -0.25}, kHigh{0.5, 1, 0.25};

/// What the header promises, one vote after the other.
VoteGrid slow_votes(const VoxelGrid& grid, const std::vector<Match>& matches) {
  std::map<std::uint32_t, Vote> votes;
  std::map<std::uint32_t, Vec3> sums;
  for (const Match& m : matches) {
    const Vec3 p = (m.position - grid.origin) / grid.size;
    const auto cell = [](double c) { return static_cast<int>(std::floor(c)); };
    const std::uint32_t voxel = grid.index(cell(p.x), cell(p.y), cell(p.z));
    Vote& v = votes.try_emplace(voxel, Vote{voxel, 0, 0xffff, 0, 0, {}}).first->second;
    ++v.count;
    v.radius = std::min(v.radius, m.radius);
    sums[voxel] += m.position;
  }
  VoteGrid result{grid, {}};
  for (auto& [voxel, vote] : votes) {
    vote.position = sums[voxel] / vote.count;
    result.votes.push_back(vote);
  }
  return result;
}

}  // namespace

TEST_CASE("voxel grid: odd along each side, padded, around the middle of the box") {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 low = random.vector();
    const Vec3 extent{random.unit(), random.unit(), i % 3 == 0 ? 0 : random.unit()};
    const Vec3 high = low + extent;
    const int resolution = 16 + static_cast<int>(random.below(150));
    const VoxelGrid grid = make_voxel_grid(low, high, resolution);
    INFO("box " << i << ", resolution " << resolution);
    CHECK(grid.nx % 2 == 1);
    CHECK(grid.ny % 2 == 1);
    CHECK(grid.nz % 2 == 1);
    const double longest = std::max({extent.x, extent.y, extent.z});
    CHECK(grid.size == Approx(longest / resolution).epsilon(1e-12));
    const Vec3 top =
        grid.origin + Vec3{double(grid.nx), double(grid.ny), double(grid.nz)} * grid.size;
    CHECK(distance(grid.origin + top, low + high) < 1e-12);
    for (const Vec3& gap : {(low - grid.origin) / grid.size, (top - high) / grid.size})
      for (const double g : {gap.x, gap.y, gap.z}) {
        CHECK(g >= 2 - 1e-6);
        CHECK(g <= 3.5 + 1e-6);
      }
  }
  CHECK(make_voxel_grid({-1, -1, -1}, {1, 1, 1}, 128).nx == 133);
  CHECK(make_voxel_grid({-1, -1, -1}, {1, 1, 1}, 127).nx == 131);
}

TEST_CASE("voxel grid: an index and its three parts") {
  const VoxelGrid grid = make_voxel_grid({0, 0, 0}, {1, 2, 3}, 20);
  REQUIRE(grid.count() == static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) *
                              static_cast<std::size_t>(grid.nz));
  std::uint32_t next = 0;
  for (int z = 0; z < grid.nz; ++z)
    for (int y = 0; y < grid.ny; ++y)
      for (int x = 0; x < grid.nx; ++x, ++next) {
        if (grid.index(x, y, z) != next) FAIL("index out of order");
        if (grid.x_of(next) != x || grid.y_of(next) != y || grid.z_of(next) != z)
          FAIL("parts of " << next);
      }
  CHECK(next == grid.count());
  CHECK(distance(grid.center(0), grid.origin + Vec3{0.5, 0.5, 0.5} * grid.size) < 1e-15);
  CHECK(distance(grid.center(grid.index(3, 4, 5)), grid.origin + Vec3{3.5, 4.5, 5.5} * grid.size) <
        1e-14);
  CHECK(grid.contains(0, 0, 0));
  CHECK(grid.contains(grid.nx - 1, grid.ny - 1, grid.nz - 1));
  CHECK_FALSE(grid.contains(grid.nx, 0, 0));
  CHECK_FALSE(grid.contains(0, grid.ny, 0));
  CHECK_FALSE(grid.contains(0, 0, grid.nz));
  CHECK_FALSE(grid.contains(-1, 0, 0));
}

TEST_CASE("votes: counted, least radius, exact mean of the positions, in the order of the index") {
  const VoxelGrid grid = make_voxel_grid(kLow, kHigh, 40);
  const auto matches = random_matches(20000, kLow, kHigh);
  VoteAccumulator accumulator(grid);
  accumulator.vote(matches);
  const VoteGrid votes = std::move(accumulator).finish();
  const VoteGrid expected = slow_votes(grid, matches);
  REQUIRE(votes.votes.size() == expected.votes.size());
  CHECK(votes == expected);
  CHECK(std::move(VoteAccumulator(grid)).finish().votes.empty());
}

TEST_CASE("votes: one with the least and one with the greatest distance") {
  const VoxelGrid grid = make_voxel_grid(kLow, kHigh, 16);
  for (const ChamferDistance radius : std::array<ChamferDistance, 3>{0, 1, 65535}) {
    VoteAccumulator accumulator(grid);
    accumulator.vote(std::vector<Match>{{{0.125, 0.25, -0.0625}, radius}});
    const VoteGrid votes = std::move(accumulator).finish();
    REQUIRE(votes.votes.size() == 1);
    CHECK(votes.votes[0].radius == radius);
    CHECK(votes.votes[0].count == 1);
    CHECK(votes.votes[0].position == Vec3{0.125, 0.25, -0.0625});
  }
}

TEST_CASE("votes: stay off the outermost layer") {
  const VoxelGrid grid = make_voxel_grid({-1, -1, -1}, {1, 1, 1}, 16);
  const double far = grid.size * grid.nx / 2;  // the grid's own border
  for (const double reach : {1.0, far - 1e-9, far}) {
    VoteAccumulator accumulator(grid);
    for (int i = 0; i < 27; ++i) {
      const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
      const Vec3 p{reach * x, reach * y, reach * z};
      accumulator.vote(std::vector<Match>{{p, 9}});
    }
    const VoteGrid votes = std::move(accumulator).finish();
    REQUIRE(votes.votes.size() == 27);
    for (const Vote& v : votes.votes) {
      const int c[] = {grid.x_of(v.voxel), grid.y_of(v.voxel), grid.z_of(v.voxel)};
      CHECK(*std::min_element(c, c + 3) >= 1);
      CHECK(*std::max_element(c, c + 3) <= grid.nx - 2);
    }
  }
}

TEST_CASE("votes: more than are summed up at once") {
  const VoxelGrid grid = make_voxel_grid(kLow, kHigh, 40);
  const auto matches =
      random_matches(static_cast<std::size_t>(scaled(900000, 300000)), kLow, kHigh);
  VoteAccumulator accumulator(grid);
  for (std::size_t i = 0; i < matches.size(); i += 1000)
    accumulator.vote(std::span(matches).subspan(i, 1000));
  const VoteGrid result = std::move(accumulator).finish();
  CHECK(result == slow_votes(grid, matches));
}

TEST_CASE("votes: any threads give the same grid") {
  const VoxelGrid grid = make_voxel_grid(kLow, kHigh, 40);
  const auto matches = random_matches(static_cast<std::size_t>(scaled(200000, 20000)), kLow, kHigh);
  const VoteGrid expected = slow_votes(grid, matches);

  SECTION("std::thread") {
    for (const std::size_t count : {2u, 8u, 16u}) {
      VoteAccumulator accumulator(grid);
      std::atomic<bool> go{false};
      std::vector<std::thread> threads;
      for (std::size_t k = 0; k < count; ++k)
        threads.emplace_back([&, k] {
          while (!go) std::this_thread::yield();
          for (std::size_t i = k; i < matches.size(); i += count)
            accumulator.vote(std::span(matches).subspan(i, 1));
        });
      go = true;
      for (std::thread& t : threads) t.join();
      const VoteGrid result = std::move(accumulator).finish();
      CHECK(result == expected);
    }
  }

  SECTION("TBB") {
    using tbb::global_control;
    const global_control eight(global_control::max_allowed_parallelism, 8);
    for (int run = 0; run < 4; ++run) {
      VoteAccumulator accumulator(grid);
      std::atomic<std::size_t> least_threads{8};
      tbb::parallel_for(std::size_t{0}, matches.size(), [&](std::size_t i) {
        accumulator.vote(std::span(matches).subspan(i, 1));
        if (i % 1000 == 0 &&
            global_control::active_value(global_control::max_allowed_parallelism) != 8)
          least_threads = 0;
      });
      CHECK(least_threads == 8);  // nothing in the process has turned it down
      CHECK(global_control::active_value(global_control::max_allowed_parallelism) == 8);
      const VoteGrid result = std::move(accumulator).finish();
      CHECK(result == expected);
    }
  }
}
