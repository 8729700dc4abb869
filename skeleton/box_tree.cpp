#include <algorithm>
#include <array>
#include <utility>

#include "box_tree_detail.hpp"

namespace marrow {

namespace {

constexpr std::uint32_t kLeaf = 4;      // items
constexpr double kSteps = 1 << 10;      // of the order along each axis
constexpr std::uint32_t kDigit = 1024;  // of a key, when it is sorted by

/// Bit i of the ten goes to bit 3 i.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

/// Keys of the middles of boxes along a curve that keeps neighbours together (Morton, 1966).
std::vector<std::uint32_t> curve_keys(std::span<const ReachBox> boxes) {
  ReachBox all = boxes.front();
  for (const ReachBox& box : boxes) all.add(box);
  const Vec3 side = all.high - all.low;
  const double steps = kSteps / std::max({side.x, side.y, side.z, 1e-300});
  const auto step = [&](double low, double high, double from) {
    const double at = (0.5 * (low + high) - from) * steps;
    return spread(at > 0 ? static_cast<std::uint32_t>(std::min(at, kSteps - 1)) : 0);
  };
  std::vector<std::uint32_t> keys;
  keys.reserve(boxes.size());
  for (const auto& [low, high, reach] : boxes)
    keys.push_back(step(low.x, high.x, all.low.x) << 2 | step(low.y, high.y, all.low.y) << 1 |
                   step(low.z, high.z, all.low.z));
  return keys;
}

/// The numbers of the keys in ascending order of these; among equals the lower number first.
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& keys) {
  std::vector<std::uint32_t> order(keys.size()), other(keys.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::uint32_t shift = 0; shift < 30; shift += 10) {
    std::array<std::uint32_t, kDigit + 1> start{};
    for (const std::uint32_t key : keys) ++start[(key >> shift) % kDigit + 1];
    for (std::size_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
    for (const std::uint32_t i : order) other[start[(keys[i] >> shift) % kDigit]++] = i;
    order.swap(other);
  }
  return order;
}

}  // namespace

void ReachBox::add(const ReachBox& other) {
  low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
  high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
          std::max(high.z, other.high.z)};
  reach = std::max(reach, other.reach);
}

BoxTree::BoxTree(std::span<const ReachBox> boxes) {
  if (boxes.empty()) return;
  items_ = sorted_by(curve_keys(boxes));
  nodes_.reserve(boxes.size());
  build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

void BoxTree::build(std::span<const ReachBox> boxes, std::uint32_t begin, std::uint32_t end) {
  const std::size_t own = nodes_.size();
  const bool is_leaf = end - begin <= kLeaf;
  ReachBox box = boxes[items_[begin]];
  nodes_.push_back({box, 0, begin, is_leaf ? end : begin});
  if (is_leaf) {
    for (std::uint32_t i = begin + 1; i < end; ++i) box.add(boxes[items_[i]]);
  } else {
    // Whole leaves to the left, so that all but one are full.
    const std::uint32_t leaves = (end - begin + kLeaf - 1) / kLeaf;
    const std::uint32_t middle = begin + (leaves + 1) / 2 * kLeaf;
    build(boxes, begin, middle);
    box = nodes_[own + 1].box;
    const std::size_t second = nodes_.size();
    build(boxes, middle, end);
    box.add(nodes_[second].box);
  }
  nodes_[own].box = box;
  nodes_[own].after = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace marrow
