#include <marrow/vote_grid.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace marrow {

namespace {

constexpr double kFixed = 1 << 30;  // fixed point of positions: |position| < 2
constexpr std::size_t kLeastFold = std::size_t{1} << 18;  // ballots that are summed up at once

std::int32_t to_fixed(double coordinate) {
  return static_cast<std::int32_t>(std::llrint(coordinate * kFixed));
}

/// A voxel and where its ballot lies.
struct Place {
  std::uint32_t voxel, ballot;
};

/// One pass of a radix sort: stable, by the `bits` bits of the voxel from bit `shift` on.
void sort_by_digit(const std::vector<Place>& from, std::vector<Place>& to, int shift, int bits) {
  const std::uint32_t mask = (1u << bits) - 1;
  std::vector<std::uint32_t> next((std::size_t{1} << bits) + 1, 0);
  for (const auto& p : from) ++next[(p.voxel >> shift & mask) + 1];
  for (std::size_t d = 1; d < next.size(); ++d) next[d] += next[d - 1];
  for (const auto& p : from) to[next[p.voxel >> shift & mask]++] = p;
}

/// Sorts by voxel; all voxels are less than `count`.
void sort_by_voxel(std::vector<Place>& places, std::size_t count) {
  const int bits = (static_cast<int>(std::bit_width(count)) + 1) / 2;
  std::vector<Place> half_sorted(places.size());
  sort_by_digit(places, half_sorted, 0, bits);
  sort_by_digit(half_sorted, places, bits, bits);
}

}  // namespace

VoxelGrid make_voxel_grid(const Vec3& low, const Vec3& high, int resolution) {
  const Vec3 extent = high - low;
  const double size = std::max({extent.x, extent.y, extent.z}) / resolution;
  const auto voxels = [size](double e) {
    return (static_cast<int>(std::ceil(e / size - 1e-9)) + 4) | 1;
  };
  VoxelGrid grid{{}, size, voxels(extent.x), voxels(extent.y), voxels(extent.z)};
  const Vec3 side = Vec3{double(grid.nx), double(grid.ny), double(grid.nz)} * size;
  grid.origin = (low + high - side) * 0.5;
  return grid;
}

void VoteAccumulator::vote(std::span<const Match> matches) {
  std::vector<Ballot> fresh;
  fresh.reserve(matches.size());
  for (const auto& [position, radius] : matches) {
    const Vec3 p = (position - grid_.origin) / grid_.size;
    // Off the outermost layer, so that every voted voxel has all its neighbours.
    const int x = std::clamp(static_cast<int>(p.x), 1, grid_.nx - 2);
    const int y = std::clamp(static_cast<int>(p.y), 1, grid_.ny - 2);
    const int z = std::clamp(static_cast<int>(p.z), 1, grid_.nz - 2);
    fresh.push_back({grid_.index(x, y, z), radius, to_fixed(position.x), to_fixed(position.y),
                     to_fixed(position.z)});
  }
  const std::lock_guard lock(mutex_);
  // As many as there are sums, so that the work stays in proportion.
  if (ballots_.size() > std::max(kLeastFold, sums_.size())) fold();
  ballots_.insert(ballots_.end(), fresh.begin(), fresh.end());
}

/// Moves all ballots into the sums.
void VoteAccumulator::fold() {
  std::vector<Place> places(ballots_.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = {ballots_[i].voxel, i};
  sort_by_voxel(places, grid_.count());
  std::vector<Sum> merged;
  merged.reserve(sums_.size() + places.size());
  auto old = sums_.begin();
  for (auto place = places.begin(); place != places.end();) {
    const std::uint32_t voxel = place->voxel;
    while (old != sums_.end() && old->voxel < voxel) merged.push_back(*old++);
    Sum sum{voxel, 0, 0, 0, 0, 0xffff};
    if (old != sums_.end() && old->voxel == voxel) sum = *old++;
    for (; place != places.end() && place->voxel == voxel; ++place) {
      const Ballot& b = ballots_[place->ballot];
      ++sum.count;
      sum.x += b.x, sum.y += b.y, sum.z += b.z;
      sum.radius = std::min(sum.radius, b.radius);
    }
    merged.push_back(sum);
  }
  merged.insert(merged.end(), old, sums_.end());
  sums_ = std::move(merged);
  ballots_.clear();
}

VoteGrid VoteAccumulator::finish() && {
  fold();
  VoteGrid result{grid_, {}};
  result.votes.reserve(sums_.size());
  for (const Sum& s : sums_) {
    const Vec3 sum{static_cast<double>(s.x), static_cast<double>(s.y), static_cast<double>(s.z)};
    result.votes.push_back({s.voxel, s.count, s.radius, 0, 0, sum / (s.count * kFixed)});
  }
  return result;
}

}  // namespace marrow
