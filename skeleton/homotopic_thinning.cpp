#include <marrow/homotopic_thinning.hpp>

#include <algorithm>
#include <array>
#include <queue>

#include "simple_point_detail.hpp"

namespace marrow {

namespace {

/// Index offsets of the 26 neighbours, in the order of the bits of a Neighbourhood.
std::array<std::ptrdiff_t, 26> neighbour_offsets(const VoxelGrid& grid) {
  std::array<std::ptrdiff_t, 26> offsets{};
  std::size_t n = 0;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x != 0 || y != 0 || z != 0)
          offsets[n++] = x + std::ptrdiff_t{grid.nx} * (y + std::ptrdiff_t{grid.ny} * z);
  return offsets;
}

class Thinning {
 public:
  Thinning(const VoxelGrid& grid, VoxelSet set, std::span<const std::uint16_t> key,
           std::span<const std::uint32_t> anchors)
      : offsets_(neighbour_offsets(grid)), set_(std::move(set)), key_(key) {
    for (const auto a : anchors)
      if (set_[a]) set_[a] = kAnchor;
  }

  VoxelSet run() {
    for (std::uint32_t v = 0; v < set_.size(); ++v)
      if (set_[v] == kIn && on_border(v)) push(v);
    while (!queue_.empty()) {
      const auto voxel = static_cast<std::uint32_t>(queue_.top());
      queue_.pop();
      set_[voxel] = kIn;
      if (is_simple(neighbourhood(voxel))) remove(voxel);
    }
    for (auto& v : set_) v = v != kOut;
    return std::move(set_);
  }

 private:
  enum : std::uint8_t { kOut = 0, kIn = 1, kQueued = 2, kAnchor = 3 };

  void push(std::uint32_t voxel) {
    set_[voxel] = kQueued;
    queue_.push(std::uint64_t{key_[voxel]} << 32 | voxel);
  }

  void remove(std::uint32_t voxel) {
    set_[voxel] = kOut;
    for (const auto o : offsets_) {
      const auto n = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(voxel) + o);
      if (set_[n] == kIn && on_border(n)) push(n);
    }
  }

  bool on_border(std::uint32_t voxel) const {
    constexpr std::array<std::size_t, 6> kFaces{4, 10, 12, 13, 15, 21};
    return std::any_of(kFaces.begin(), kFaces.end(),
                       [&](std::size_t f) { return at(voxel, offsets_[f]) == kOut; });
  }

  Neighbourhood neighbourhood(std::uint32_t voxel) const {
    Neighbourhood bits = 0;
    for (std::size_t i = 0; i < 26; ++i)
      bits |= static_cast<Neighbourhood>(at(voxel, offsets_[i]) != kOut) << i;
    return bits;
  }

  std::uint8_t at(std::uint32_t voxel, std::ptrdiff_t offset) const {
    return set_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(voxel) + offset)];
  }

  std::array<std::ptrdiff_t, 26> offsets_;
  VoxelSet set_;
  std::span<const std::uint16_t> key_;
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> queue_;
};

}  // namespace

std::vector<ChamferDistance> distance_transform(const VoxelGrid& grid, const VoxelSet& set) {
  constexpr std::uint16_t kFar = 0x7fff;
  const auto offsets = neighbour_offsets(grid);
  std::array<std::uint16_t, 26> cost{};
  for (int i = 0; i < 26; ++i) {
    const int k = i < 13 ? i : i + 1;
    const int steps = (k % 3 != 1) + (k / 3 % 3 != 1) + (k / 9 != 1);
    cost[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(steps + 2);
  }
  std::vector<ChamferDistance> distance(set.size());
  for (std::size_t v = 0; v < set.size(); ++v) distance[v] = set[v] ? kFar : 0;
  const auto relax = [&](std::size_t v, std::size_t first, std::size_t last) {
    if (!set[v]) return;
    std::uint16_t best = distance[v];
    for (std::size_t i = first; i < last; ++i) {
      const auto n = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v) + offsets[i]);
      best = std::min(best, static_cast<std::uint16_t>(distance[n] + cost[i]));
    }
    distance[v] = best;
  };
  for (std::size_t v = 0; v < set.size(); ++v) relax(v, 0, 13);
  for (std::size_t v = set.size(); v-- > 0;) relax(v, 13, 26);
  return distance;
}

VoxelSet thin(const VoxelGrid& grid, VoxelSet set, std::span<const std::uint16_t> key,
              std::span<const std::uint32_t> anchors) {
  return Thinning(grid, std::move(set), key, anchors).run();
}

}  // namespace marrow
