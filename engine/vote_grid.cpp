#include <marrow/vote_grid.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

namespace marrow {

namespace {

constexpr double kFixed = 1 << 30;       // fixed point of positions: |position| <= 2
constexpr std::uint32_t kNone = 0;       // no cell yet
constexpr std::uint32_t kPending = ~0u;  // a thread is fetching one

/// Zeroed memory that costs nothing until it is touched.
template <class T>
T* zeroed(std::size_t count) {
  void* memory = std::calloc(count, sizeof(T));
  if (memory == nullptr) throw std::bad_alloc();
  return static_cast<T*>(memory);
}

void raise_to(std::atomic<std::uint32_t>& value, std::uint32_t candidate) {
  std::uint32_t seen = value.load(std::memory_order_relaxed);
  while (seen < candidate &&
         !value.compare_exchange_weak(seen, candidate, std::memory_order_relaxed)) {
  }
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

void VoteAccumulator::Free::operator()(void* memory) const { std::free(memory); }

VoteAccumulator::VoteAccumulator(const VoxelGrid& grid)
    : grid_(grid),
      cell_index_(zeroed<std::atomic<std::uint32_t>>(grid.count())),
      cells_(zeroed<Cell>(grid.count() + 1)) {}

VoteAccumulator::Cell& VoteAccumulator::cell_of(std::uint32_t voxel) {
  auto& index = cell_index_[voxel];
  std::uint32_t seen = index.load(std::memory_order_acquire);
  if (seen == kNone && index.compare_exchange_strong(seen, kPending, std::memory_order_acquire)) {
    seen = 1 + used_cells_.fetch_add(1, std::memory_order_relaxed);
    index.store(seen, std::memory_order_release);
  }
  while (seen == kPending) seen = index.load(std::memory_order_acquire);
  return cells_[seen];
}

void VoteAccumulator::vote(const Vec3& position, ChamferDistance radius) {
  const Vec3 p = (position - grid_.origin) / grid_.size;
  // Off the outermost layer, so that every voted voxel has all its neighbours.
  const int x = std::clamp(static_cast<int>(p.x), 1, grid_.nx - 2);
  const int y = std::clamp(static_cast<int>(p.y), 1, grid_.ny - 2);
  const int z = std::clamp(static_cast<int>(p.z), 1, grid_.nz - 2);
  Cell& cell = cell_of(grid_.index(x, y, z));
  constexpr auto relaxed = std::memory_order_relaxed;
  cell.count.fetch_add(1, relaxed);
  raise_to(cell.inverse_radius, 0xffffu - radius);
  cell.x.fetch_add(std::llrint(position.x * kFixed), relaxed);
  cell.y.fetch_add(std::llrint(position.y * kFixed), relaxed);
  cell.z.fetch_add(std::llrint(position.z * kFixed), relaxed);
}

VoteGrid VoteAccumulator::finish() && {
  VoteGrid result{grid_, {}};
  result.votes.reserve(used_cells_.load());
  const auto voxels = static_cast<std::uint32_t>(grid_.count());
  for (std::uint32_t voxel = 0; voxel < voxels; ++voxel) {
    const std::uint32_t index = cell_index_[voxel].load(std::memory_order_relaxed);
    if (index == kNone) continue;
    const Cell& c = cells_[index];
    const Vec3 sum{static_cast<double>(c.x.load()), static_cast<double>(c.y.load()),
                   static_cast<double>(c.z.load())};
    const std::uint32_t count = c.count.load();
    const auto radius = static_cast<ChamferDistance>(0xffffu - c.inverse_radius.load());
    result.votes.push_back({voxel, count, radius, 0, 0, sum / (count * kFixed)});
  }
  return result;
}

}  // namespace marrow
