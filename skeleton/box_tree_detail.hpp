// A tree of boxes around anything, for questions about places.
#pragma once

#include <marrow/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// What it holds reaches no farther than `reach` beyond the box itself.
struct ReachBox {
  Vec3 low, high;
  double reach = 0;

  void add(const ReachBox& other);
  void add(const Vec3& p) { add(ReachBox{p, p}); }

  double squared_distance(const Vec3& p) const {
    const auto gap = [](double v, double from, double to) {
      return v < from ? from - v : v > to ? v - to : 0.0;
    };
    return squared_length(
        Vec3{gap(p.x, low.x, high.x), gap(p.y, low.y, high.y), gap(p.z, low.z, high.z)});
  }
};

/// Items are their numbers, below the number of boxes. Coordinates are near 1.
class BoxTree {
 public:
  explicit BoxTree(std::span<const ReachBox> boxes);

  /// Calls visit(item) for every item in a leaf of the tree, as far as enter(box) holds for all
  /// boxes around it, until one visit returns true; whether one did. The order is fixed.
  template <class Enter, class Visit>
  bool any(const Enter& enter, const Visit& visit) const {
    for (std::size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (!enter(node.box)) {
        n = node.after;
        continue;
      }
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        if (visit(items_[i])) return true;
      ++n;
    }
    return false;
  }

 private:
  struct Node {
    ReachBox box;
    std::uint32_t after;       // the next node that is not below this one
    std::uint32_t begin, end;  // of the items; none where there are nodes below
  };

  void build(std::span<const ReachBox> boxes, std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;  // children come right behind their parent
  std::vector<std::uint32_t> items_;
};

}  // namespace marrow
