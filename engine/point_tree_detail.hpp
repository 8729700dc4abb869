// A balanced tree of boxes over points, whose leaves are full.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace marrow {

using PointF = std::array<float, 3>;

struct BoxF {
  PointF low, high;

  /// The box of nothing.
  static BoxF none() {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  }
  void add(const BoxF& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  std::size_t longest_side() const {
    const PointF side{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    return static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
  }
};

struct PointTree {
  static constexpr std::uint32_t kLeaf = 16;  // points; a power of two
  static constexpr std::uint32_t kNone = ~0U;

  struct Node {
    BoxF box;
    std::uint32_t begin, end;  ///< its points
    std::uint32_t parent;
    std::uint32_t first = kNone, second = kNone;  ///< children

    bool is_leaf() const { return first == kNone; }
  };

  std::vector<Node> nodes;                 ///< the root first
  std::vector<std::uint32_t> order;        ///< which points were given, leaf by leaf
  std::array<std::vector<float>, 3> axes;  ///< in that order; the last point fills up its leaf
};

/// Takes the least time where the points are within [-0.5, 0.5] along every axis. There is one.
PointTree make_point_tree(std::span<const PointF> points);

}  // namespace marrow
