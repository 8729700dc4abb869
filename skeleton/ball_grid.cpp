#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "ball_grid_detail.hpp"

namespace marrow {

namespace {

/// A little more than a ball is wide, so that no rounding lets it reach into a ninth cell.
constexpr double kWidth = 2.001;

std::uint64_t key_of(std::size_t size, const std::array<std::int64_t, 3>& cell) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 19) - 1;
  std::uint64_t key = size;
  for (const std::int64_t c : cell) key = key << 19 | (static_cast<std::uint64_t>(c) & kMask);
  return key;
}

std::array<double, 3> in_cells(const Vec3& p, double size) {
  return {p.x / size, p.y / size, p.z / size};
}

}  // namespace

BallGrid::BallGrid(const VoteGraph& graph, double least_radius)
    : cells_(std::bit_ceil(std::max<std::size_t>(16, 2 * graph.nodes.size()))),
      after_(graph.nodes.size(), kNone) {
  const auto size_of = [&](double radius) {
    double most = least_radius;
    while (most < radius) most *= 2;
    return kWidth * most;
  };
  for (const auto& n : graph.nodes) sizes_.push_back(size_of(n.radius));
  const std::vector<double> size_at = sizes_;
  std::sort(sizes_.begin(), sizes_.end());
  sizes_.erase(std::unique(sizes_.begin(), sizes_.end()), sizes_.end());
  for (auto n = static_cast<NodeId>(graph.nodes.size()); n-- > 0;) {
    const auto size = std::lower_bound(sizes_.begin(), sizes_.end(), size_at[n]);
    std::array<std::int64_t, 3> cell{};
    const auto at = in_cells(graph.nodes[n].position, *size);
    for (std::size_t i = 0; i < 3; ++i) cell[i] = static_cast<std::int64_t>(std::floor(at[i]));
    const std::uint64_t key = key_of(static_cast<std::size_t>(size - sizes_.begin()), cell);
    Cell& found = cells_[find(key)];
    after_[n] = found.first;
    found = {key, n};
  }
}

std::size_t BallGrid::find(std::uint64_t key) const {
  std::uint64_t hash = key * 0x9e3779b97f4a7c15u;
  hash ^= hash >> 32;
  for (;; ++hash) {
    const std::size_t slot = hash & (cells_.size() - 1);
    if (cells_[slot].key == key || cells_[slot].key == kNoKey) return slot;
  }
}

NodeId BallGrid::next(const Vec3& p, Search& search) const {
  while (search.next == kNone) {
    const std::uint32_t size = search.cells_seen / 8, corner = search.cells_seen % 8;
    if (size == sizes_.size()) return kNone;
    ++search.cells_seen;
    std::array<std::int64_t, 3> cell{};
    const auto at = in_cells(p, sizes_[size]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = std::floor(at[i]);
      const int beside = at[i] - low < 0.5 ? -1 : 1;
      cell[i] = static_cast<std::int64_t>(low) + ((corner >> i & 1) != 0 ? beside : 0);
    }
    search.next = cells_[find(key_of(size, cell))].first;
  }
  const NodeId found = search.next;
  search.next = after_[found];
  return found;
}

}  // namespace marrow
