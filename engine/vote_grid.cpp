#include <marrow/vote_grid.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "sparse_array_detail.hpp"

namespace marrow {

namespace {

constexpr double kFixed = 1 << 30;       // fixed point of positions: |position| < 2
constexpr std::uint32_t kNone = 0;       // no cell yet
constexpr std::uint32_t kPending = ~0u;  // a thread is fetching one
constexpr std::size_t kSide = 8;         // of a block of voxels

std::int32_t to_fixed(double coordinate) {
  return static_cast<std::int32_t>(std::llrint(coordinate * kFixed));
}

void raise_to(std::atomic<std::uint32_t>& value, std::uint32_t candidate) {
  std::uint32_t seen = value.load(std::memory_order_relaxed);
  while (seen < candidate &&
         !value.compare_exchange_weak(seen, candidate, std::memory_order_relaxed)) {
  }
}

/// A voxel and where what belongs to it lies.
struct Place {
  std::uint32_t voxel, index;
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

namespace {

/// What the matches of one call say of one voxel.
struct Sum {
  std::uint32_t voxel, count;
  std::int64_t x, y, z;
  ChamferDistance radius;  // the least
};

/// What all matches say of one voxel.
struct Cell {
  std::atomic<std::uint32_t> voxel;
  std::atomic<std::uint32_t> count;
  std::atomic<std::uint32_t> inverse_radius;  // 0xffff - radius: zeroes are an empty cell
  std::atomic<std::int64_t> x, y, z;          // sums in fixed point
};

/// Off the outermost layer, so that every voted voxel has all its neighbours.
std::uint32_t voxel_at(const VoxelGrid& grid, const Vec3& position) {
  const Vec3 p = (position - grid.origin) / grid.size;
  return grid.index(std::clamp(static_cast<int>(p.x), 1, grid.nx - 2),
                    std::clamp(static_cast<int>(p.y), 1, grid.ny - 2),
                    std::clamp(static_cast<int>(p.z), 1, grid.nz - 2));
}

std::size_t blocks_along(int voxels) {
  return (static_cast<std::size_t>(voxels) + kSide - 1) / kSide;
}

}  // namespace

/// The one grid that all views vote in. Cells are handed out as voxels are first voted for; which
/// cell a voxel gets depends on the schedule, what it holds does not.
class VoteAccumulator::Cells {
 public:
  explicit Cells(const VoxelGrid& grid)
      : grid_(grid),
        blocks_x_(blocks_along(grid.nx)),
        blocks_y_(blocks_along(grid.ny)),
        cell_of_(blocks_x_ * blocks_y_ * blocks_along(grid.nz) * kSide * kSide * kSide),
        cells_(grid.count() + 1) {}

  void add(const Sum& sum) {
    constexpr auto relaxed = std::memory_order_relaxed;
    Cell& cell = at(sum.voxel);
    cell.count.fetch_add(sum.count, relaxed);
    raise_to(cell.inverse_radius, 0xffffu - sum.radius);
    cell.x.fetch_add(sum.x, relaxed);
    cell.y.fetch_add(sum.y, relaxed);
    cell.z.fetch_add(sum.z, relaxed);
  }

  std::uint32_t count() const { return used_.load(); }
  const Cell& operator[](std::uint32_t i) { return cells_[i]; }

 private:
  /// Voxels that are near each other lie in one block: votes come in clusters.
  std::size_t place_of(std::uint32_t voxel) const {
    const auto x = static_cast<std::size_t>(grid_.x_of(voxel)),
               y = static_cast<std::size_t>(grid_.y_of(voxel)),
               z = static_cast<std::size_t>(grid_.z_of(voxel));
    const std::size_t block = x / kSide + blocks_x_ * (y / kSide + blocks_y_ * (z / kSide));
    return x % kSide + kSide * (y % kSide + kSide * (z % kSide + kSide * block));
  }

  Cell& at(std::uint32_t voxel) {
    auto& index = cell_of_[place_of(voxel)];
    std::uint32_t seen = index.load(std::memory_order_acquire);
    if (seen == kNone && index.compare_exchange_strong(seen, kPending, std::memory_order_acquire)) {
      seen = used_.fetch_add(1, std::memory_order_relaxed) + 1;
      cells_[seen - 1].voxel.store(voxel, std::memory_order_relaxed);
      index.store(seen, std::memory_order_release);
    }
    while (seen == kPending) seen = index.load(std::memory_order_acquire);
    return cells_[seen - 1];
  }

  VoxelGrid grid_;
  std::size_t blocks_x_, blocks_y_;
  SparseArray<std::atomic<std::uint32_t>, kSide * kSide * kSide> cell_of_;  // 1 and up
  SparseArray<Cell, 1024> cells_;
  std::atomic<std::uint32_t> used_{0};
};

VoteAccumulator::VoteAccumulator(const VoxelGrid& grid)
    : grid_(grid), cells_(std::make_unique<Cells>(grid)) {}

VoteAccumulator::~VoteAccumulator() = default;

/// Matches of one voxel are summed up first: an atomic addition costs more than a place in a sort.
void VoteAccumulator::vote(std::span<const Match> matches) {
  std::vector<Place> places;
  places.reserve(matches.size());
  for (std::uint32_t i = 0; i < matches.size(); ++i)
    places.push_back({voxel_at(grid_, matches[i].position), i});
  sort_by_voxel(places, grid_.count());
  for (auto place = places.begin(); place != places.end();) {
    Sum sum{place->voxel, 0, 0, 0, 0, 0xffff};
    for (; place != places.end() && place->voxel == sum.voxel; ++place) {
      const auto& [position, radius] = matches[place->index];
      ++sum.count;
      sum.x += to_fixed(position.x), sum.y += to_fixed(position.y), sum.z += to_fixed(position.z);
      sum.radius = std::min(sum.radius, radius);
    }
    cells_->add(sum);
  }
}

VoteGrid VoteAccumulator::finish() && {
  Cells& cells = *cells_;
  std::vector<Place> places(cells.count());
  for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = {cells[i].voxel.load(), i};
  sort_by_voxel(places, grid_.count());
  VoteGrid result{grid_, {}};
  result.votes.reserve(places.size());
  for (const Place& place : places) {
    const Cell& c = cells[place.index];
    const Vec3 sum{static_cast<double>(c.x.load()), static_cast<double>(c.y.load()),
                   static_cast<double>(c.z.load())};
    const std::uint32_t count = c.count.load();
    const auto radius = static_cast<ChamferDistance>(0xffffu - c.inverse_radius.load());
    result.votes.push_back({place.voxel, count, radius, 0, 0, sum / (count * kFixed)});
  }
  return result;
}

}  // namespace marrow
