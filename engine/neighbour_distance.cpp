#include <cmath>

#include "neighbour_distance_detail.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "neighbour_distance.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace marrow::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kLeaf = PointTree::kLeaf;
constexpr float kFar = std::numeric_limits<float>::infinity();
static_assert(kNeighbour == 8);  // as many as there are variables in meet()

/// Not above the computed squared distance of any two points of the boxes: rounding is monotonic.
inline float squared_gap(const BoxF& a, const BoxF& b) {
  float sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float gap = std::max({a.low[k] - b.high[k], b.low[k] - a.high[k], 0.0F});
    sum += gap * gap;
  }
  return sum;
}

/// Squared distances of the points of one leaf, each in a lane, to the nearest others so far.
struct Answer {
  const PointTree::Node& leaf;
  float bound = kFar;                                 ///< the greatest of the last row
  alignas(64) float nearest[kNeighbour][kLeaf] = {};  ///< ascending in every lane
};

/// The lesser ones stay in `slot`, the greater go on in `distance`.
template <class V>
HWY_INLINE void exchange(V& slot, V& distance) {
  const V less = hn::Min(slot, distance);
  distance = hn::Max(slot, distance);
  slot = less;
}

class LeafQueries {
 public:
  explicit LeafQueries(const PointTree& tree) : tree_(tree) {}

  Answer answer_of(std::uint32_t leaf) const {
    Answer answer{tree_.nodes[leaf]};
    for (auto& row : answer.nearest) std::fill_n(row, kLeaf, kFar);
    meet(answer, answer.leaf);
    // Up the tree: what is near comes first, and prunes the rest.
    for (std::uint32_t n = leaf; tree_.nodes[n].parent != PointTree::kNone;
         n = tree_.nodes[n].parent) {
      const PointTree::Node& parent = tree_.nodes[tree_.nodes[n].parent];
      const PointTree::Node& other = tree_.nodes[parent.first == n ? parent.second : parent.first];
      descend(answer, other, squared_gap(answer.leaf.box, other.box));
    }
    return answer;
  }

 private:
  void descend(Answer& answer, const PointTree::Node& node, float gap) const {
    if (gap >= answer.bound) return;
    if (node.is_leaf()) return meet(answer, node);
    const PointTree::Node* near = &tree_.nodes[node.first];
    const PointTree::Node* far = &tree_.nodes[node.second];
    float near_gap = squared_gap(answer.leaf.box, near->box);
    float far_gap = squared_gap(answer.leaf.box, far->box);
    if (far_gap < near_gap) {
      std::swap(near, far);
      std::swap(near_gap, far_gap);
    }
    descend(answer, *near, near_gap);
    descend(answer, *far, far_gap);
  }

  void meet(Answer& answer, const PointTree::Node& other) const {
    const hn::CappedTag<float, kLeaf> d;
    auto bound = hn::Zero(d);
    for (std::size_t i = 0; i < kLeaf; i += hn::Lanes(d))
      bound = hn::Max(bound, meet_lanes(d, answer, i, other));
    answer.bound = hn::GetLane(hn::MaxOfLanes(d, bound));
  }

  /// Multiplies and adds apart, never fused: the last bit is the same on every machine.
  template <class D>
  HWY_INLINE hn::Vec<D> meet_lanes(D d, Answer& answer, std::size_t lane,
                                   const PointTree::Node& other) const {
    const std::uint32_t mine = answer.leaf.begin + static_cast<std::uint32_t>(lane);
    const auto x = hn::LoadU(d, &tree_.axes[0][mine]), y = hn::LoadU(d, &tree_.axes[1][mine]),
               z = hn::LoadU(d, &tree_.axes[2][mine]);
    float* const rows = answer.nearest[0] + lane;
    auto a = hn::Load(d, rows), b = hn::Load(d, rows + kLeaf), c = hn::Load(d, rows + 2 * kLeaf),
         e = hn::Load(d, rows + 3 * kLeaf), f = hn::Load(d, rows + 4 * kLeaf),
         g = hn::Load(d, rows + 5 * kLeaf), h = hn::Load(d, rows + 6 * kLeaf),
         last = hn::Load(d, rows + 7 * kLeaf);
    const bool same = other.begin == answer.leaf.begin;
    for (std::uint32_t j = other.begin; j < other.end; ++j) {
      const auto dx = hn::Sub(hn::Set(d, tree_.axes[0][j]), x);
      const auto dy = hn::Sub(hn::Set(d, tree_.axes[1][j]), y);
      const auto dz = hn::Sub(hn::Set(d, tree_.axes[2][j]), z);
      auto distance = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      if (same && j - mine < hn::Lanes(d)) distance = without_lane(d, distance, j - mine);
      if (hn::AllFalse(d, hn::Lt(distance, last))) continue;
      exchange(a, distance);
      exchange(b, distance);
      exchange(c, distance);
      exchange(e, distance);
      exchange(f, distance);
      exchange(g, distance);
      exchange(h, distance);
      last = hn::Min(last, distance);
    }
    hn::Store(a, d, rows);
    hn::Store(b, d, rows + kLeaf);
    hn::Store(c, d, rows + 2 * kLeaf);
    hn::Store(e, d, rows + 3 * kLeaf);
    hn::Store(f, d, rows + 4 * kLeaf);
    hn::Store(g, d, rows + 5 * kLeaf);
    hn::Store(h, d, rows + 6 * kLeaf);
    hn::Store(last, d, rows + 7 * kLeaf);
    return last;
  }

  /// A point is no neighbour of itself.
  template <class D>
  static HWY_INLINE hn::Vec<D> without_lane(D d, hn::Vec<D> distance, std::uint32_t lane) {
    const auto own = hn::Eq(hn::Iota(d, 0), hn::Set(d, static_cast<float>(lane)));
    return hn::IfThenElse(own, hn::Set(d, kFar), distance);
  }

  const PointTree& tree_;
};

std::vector<float> distances_on_target(const PointTree& tree) {
  const LeafQueries queries(tree);
  const std::size_t count = tree.order.size();
  std::vector<float> result(count, 0);
  if (count < 2) return result;
  const std::size_t row = std::min<std::size_t>(kNeighbour, count - 1) - 1;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const PointTree::Node& node = tree.nodes[n];
    if (!node.is_leaf()) continue;
    const Answer answer = queries.answer_of(n);
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      result[tree.order[i]] = std::sqrt(answer.nearest[row][i - node.begin]);
  }
  return result;
}

}  // namespace marrow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace marrow {

HWY_EXPORT(distances_on_target);

std::vector<float> neighbour_distances(std::span<const PointF> points) {
  if (points.empty()) return {};
  return HWY_DYNAMIC_DISPATCH(distances_on_target)(make_point_tree(points));
}

}  // namespace marrow
#endif
