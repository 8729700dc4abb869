#include "point_tree_detail.hpp"

namespace marrow {

namespace {

constexpr std::uint32_t kBits = 5;  // of a cell's place along an axis
constexpr std::uint32_t kCells = 1U << kBits;
constexpr std::uint32_t kFew = 32 * PointTree::kLeaf;  // points that are sorted as they are

struct Place {
  PointF point;
  std::uint32_t index;
};

/// Bit i of `value` to bit 3 i.
std::uint32_t spread(std::uint32_t value) {
  std::uint32_t wide = 0;
  for (std::uint32_t i = 0; i < kBits; ++i) wide |= (value >> i & 1) << (3 * i);
  return wide;
}

/// The number of a point's cell along the curve of Morton: what is near in it is near in space.
class Cells {
 public:
  Cells() {
    for (std::uint32_t i = 0; i < kCells; ++i) spread_[i] = spread(i);
  }
  std::uint32_t of(const PointF& p) const {
    return spread_[along(p[0])] | spread_[along(p[1])] << 1 | spread_[along(p[2])] << 2;
  }

 private:
  static std::size_t along(float x) {
    return static_cast<std::size_t>(std::clamp((x + 0.5F) * kCells, 0.0F, kCells - 1.0F));
  }
  std::array<std::uint32_t, kCells> spread_;
};

BoxF box_of(std::span<const Place> places) {
  BoxF box = BoxF::none();
  for (const Place& place : places) box.add({place.point, place.point});
  return box;
}

/// Sorts by cells first, all at once; only what is in one of them, or few, is sorted by halves.
class TreeBuilder {
 public:
  explicit TreeBuilder(std::span<const PointF> points) : places_(points.size()) {
    sort_by_cells(points);
    tree_.nodes.reserve(4 * (points.size() / PointTree::kLeaf + 1));
    build(0, static_cast<std::uint32_t>(points.size()), true, PointTree::kNone);
  }

  PointTree take() {
    const std::size_t count = places_.size();
    tree_.order.reserve(count);
    for (const Place& place : places_) tree_.order.push_back(place.index);
    for (std::size_t k = 0; k < 3; ++k) {
      auto& axis = tree_.axes[k];
      axis.resize((count + PointTree::kLeaf - 1) / PointTree::kLeaf * PointTree::kLeaf,
                  places_.back().point[k]);
      for (std::size_t i = 0; i < count; ++i) axis[i] = places_[i].point[k];
    }
    return std::move(tree_);
  }

 private:
  void sort_by_cells(std::span<const PointF> points) {
    std::vector<std::uint32_t> next((std::size_t{1} << (3 * kBits)) + 1);
    for (const PointF& p : points) ++next[cells_.of(p) + 1];
    for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    for (std::uint32_t i = 0; i < points.size(); ++i)
      places_[next[cells_.of(points[i])]++] = {points[i], i};
  }

  std::uint32_t build(std::uint32_t begin, std::uint32_t end, bool by_cells, std::uint32_t parent) {
    const auto id = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.push_back({BoxF::none(), begin, end, parent});
    const std::uint32_t leaves = (end - begin + PointTree::kLeaf - 1) / PointTree::kLeaf;
    if (leaves == 1) {
      tree_.nodes[id].box = box_of(range(begin, end));
      return id;
    }
    // Whole leaves to the left, so that all but one are full.
    const std::uint32_t middle = begin + (leaves + 1) / 2 * PointTree::kLeaf;
    by_cells = by_cells && end - begin > kFew && split_cell(begin, middle, end);
    if (!by_cells) split(begin, middle, end);
    const std::uint32_t first = build(begin, middle, by_cells, id);
    const std::uint32_t second = build(middle, end, by_cells, id);
    PointTree::Node& node = tree_.nodes[id];
    node.first = first;
    node.second = second;
    for (const std::uint32_t child : {first, second}) node.box.add(tree_.nodes[child].box);
    return id;
  }

  std::span<Place> range(std::uint32_t begin, std::uint32_t end) {
    return std::span(places_).subspan(begin, end - begin);
  }

  /// So that no point of [begin, middle) is beyond one of [middle, end) along the longest side.
  void split(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
    const std::span<Place> all = range(begin, end);
    const std::size_t axis = box_of(all).longest_side();
    std::nth_element(
        all.begin(), all.begin() + (middle - begin), all.end(),
        [axis](const Place& a, const Place& b) { return a.point[axis] < b.point[axis]; });
  }

  /// The same for the cell that `middle` is in, unless it has most of the points, where sorting by
  /// cells has been of no use.
  bool split_cell(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
    const std::span<Place> all = range(begin, end);
    const std::uint32_t cell = cells_.of(places_[middle].point);
    const auto from = std::partition_point(
        all.begin(), all.end(), [&](const Place& place) { return cells_.of(place.point) < cell; });
    const auto to = std::partition_point(
        from, all.end(), [&](const Place& place) { return cells_.of(place.point) == cell; });
    const auto first = begin + static_cast<std::uint32_t>(from - all.begin());
    const auto last = begin + static_cast<std::uint32_t>(to - all.begin());
    if (2 * (last - first) > end - begin) return false;
    if (first < middle) split(first, middle, last);
    return true;
  }

  const Cells cells_;
  std::vector<Place> places_;
  PointTree tree_;
};

}  // namespace

PointTree make_point_tree(std::span<const PointF> points) { return TreeBuilder(points).take(); }

}  // namespace marrow
