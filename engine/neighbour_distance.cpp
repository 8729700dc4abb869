#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "neighbour_distance_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kLeaf = 12;  // points
constexpr float kFar = std::numeric_limits<float>::infinity();

struct BoxF {
  PointF low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

  void add(const PointF& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  std::size_t longest_side() const {
    const PointF side{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    return static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
  }
};

/// Not above the computed squared distance of any two points of the boxes: rounding is monotonic.
float squared_gap(const BoxF& a, const BoxF& b) {
  float sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float gap = std::max({a.low[k] - b.high[k], b.low[k] - a.high[k], 0.0F});
    sum += gap * gap;
  }
  return sum;
}

/// The least squared distances of one point so far, ascending.
class Nearest {
 public:
  Nearest() { distances_.fill(kFar); }

  float bound() const { return distances_.back(); }
  void add(float distance) {
    std::size_t i = distances_.size() - 1;
    for (; i > 0 && distances_[i - 1] > distance; --i) distances_[i] = distances_[i - 1];
    distances_[i] = distance;
  }
  /// The last one that there is.
  float farthest() const {
    const auto end = std::find(distances_.begin(), distances_.end(), kFar);
    return end == distances_.begin() ? 0 : *(end - 1);
  }

 private:
  std::array<float, kNeighbour> distances_;
};

/// A balanced tree of boxes whose leaves answer for all of their points together.
class PointTree {
 public:
  explicit PointTree(std::span<const PointF> points) : places_(points.size()) {
    for (std::uint32_t i = 0; i < places_.size(); ++i) places_[i] = {points[i], i};
    nodes_.reserve(4 * (points.size() / kLeaf + 1));
    build(0, points.size(), kNone);
    for (auto& axis : axes_) axis.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) axes_[k][i] = places_[i].point[k];
  }

  std::vector<float> distances() const {
    std::vector<float> result(places_.size());
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (!nodes_[n].is_leaf()) continue;
      Answer answer = answer_of(n);
      for (std::size_t i = 0; i < nodes_[n].end - nodes_[n].begin; ++i)
        result[places_[nodes_[n].begin + i].index] = std::sqrt(answer.nearest[i].farthest());
    }
    return result;
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;
  struct Place {
    PointF point;
    std::uint32_t index;
  };
  struct Node {
    BoxF box;
    std::size_t begin, end;
    std::uint32_t parent, first = kNone, second = kNone;  // children

    bool is_leaf() const { return first == kNone; }
  };
  /// Of the points of one leaf.
  struct Answer {
    std::uint32_t leaf;
    std::array<Nearest, kLeaf> nearest;
    float bound = kFar;  // the greatest of theirs
  };

  std::uint32_t build(std::size_t begin, std::size_t end, std::uint32_t parent) {
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    Node node{{}, begin, end, parent};
    for (std::size_t i = begin; i < end; ++i) node.box.add(places_[i].point);
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return id;
    const std::size_t axis = node.box.longest_side();
    // Whole leaves to the left, so that all but one are full.
    const std::size_t leaves = (end - begin + kLeaf - 1) / kLeaf;
    const std::size_t middle = begin + (leaves + 1) / 2 * kLeaf;
    const auto at = [&](std::size_t i) { return places_.begin() + static_cast<std::ptrdiff_t>(i); };
    if (middle < end)
      std::nth_element(at(begin), at(middle), at(end), [axis](const Place& a, const Place& b) {
        return a.point[axis] < b.point[axis];
      });
    const std::uint32_t first = build(begin, std::min(middle, end), id);
    const std::uint32_t second = build(std::min(middle, end), end, id);
    nodes_[id].first = first;
    nodes_[id].second = second;
    return id;
  }

  Answer answer_of(std::uint32_t leaf) const {
    Answer answer{leaf, {}};
    meet(answer, leaf);
    // Up the tree: what is near comes first, and prunes the rest.
    for (std::uint32_t n = leaf; nodes_[n].parent != kNone; n = nodes_[n].parent) {
      const Node& parent = nodes_[nodes_[n].parent];
      descend(answer, parent.first == n ? parent.second : parent.first);
    }
    return answer;
  }

  void descend(Answer& answer, std::uint32_t n) const {
    const BoxF& box = nodes_[answer.leaf].box;
    if (squared_gap(box, nodes_[n].box) >= answer.bound) return;
    if (nodes_[n].is_leaf()) return meet(answer, n);
    std::uint32_t near = nodes_[n].first, far = nodes_[n].second;
    if (squared_gap(box, nodes_[far].box) < squared_gap(box, nodes_[near].box))
      std::swap(near, far);
    descend(answer, near);
    descend(answer, far);
  }

  /// The points of the answer's leaf meet those of leaf `other`.
  void meet(Answer& answer, std::uint32_t other) const {
    const Node &mine = nodes_[answer.leaf], &theirs = nodes_[other];
    answer.bound = 0;
    for (std::size_t i = mine.begin; i < mine.end; ++i) {
      Nearest& nearest = answer.nearest[i - mine.begin];
      std::array<float, kLeaf> squared;
      for (std::size_t j = theirs.begin; j < theirs.end; ++j) {
        const float x = axes_[0][j] - axes_[0][i], y = axes_[1][j] - axes_[1][i],
                    z = axes_[2][j] - axes_[2][i];
        squared[j - theirs.begin] = x * x + y * y + z * z;
      }
      for (std::size_t j = theirs.begin; j < theirs.end; ++j)
        if (j != i && squared[j - theirs.begin] < nearest.bound())
          nearest.add(squared[j - theirs.begin]);
      answer.bound = std::max(answer.bound, nearest.bound());
    }
  }

  std::vector<Place> places_;
  std::vector<Node> nodes_;
  std::array<std::vector<float>, 3> axes_;
};

}  // namespace

std::vector<float> neighbour_distances(std::span<const PointF> points) {
  if (points.empty()) return {};
  return PointTree(points).distances();
}

}  // namespace marrow
