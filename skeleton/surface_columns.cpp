#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

#include "surface_columns_detail.hpp"

namespace marrow {

namespace {

constexpr float kMost = 1.01F;               // of a coordinate
constexpr int kMargin = 4;                   // cells, when columns are filled again
constexpr int kCoarsest = 18, kCoarser = 2;  // shifts
constexpr int kWidest = 4;                   // cells along a side of what a level takes
constexpr std::uint8_t kNowhere = 0xff;

/// As fine as the triangles, as far as their number tells.
int finest_shift(std::size_t triangles) {
  int shift = 14;
  for (std::size_t few = 4'000; few < triangles && shift > 10; few *= 4) --shift;
  return shift;
}

Vec3 corner(const NormalizedShape& shape, std::size_t i) {
  return {double{shape.x[i]}, double{shape.y[i]}, double{shape.z[i]}};
}

/// The cells of all coordinates along one axis: snap_to_lattice(), many at once.
std::vector<std::int32_t> cells_along(std::span<const float> coordinates,
                                      const ColumnCells& cells) {
  constexpr float kSteps = kLatticeSteps, kRounding = 0x1.8p23f;  // above 2^23 floats are integers
  std::vector<std::int32_t> result(coordinates.size());
  const int shift = cells.shift, middle = cells.count / 2;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const float at = std::min(std::max(coordinates[i], -kMost), kMost) * kSteps + kRounding;
    const int steps = std::bit_cast<std::int32_t>(at) - std::bit_cast<std::int32_t>(kRounding);
    result[i] = (steps >> shift) + middle;
  }
  return result;
}

/// Whether one of `count` cells, `stride` apart, is set up to `reach` cells before or after each.
void widen_line(const std::uint8_t* in, std::uint8_t* out, int count, std::size_t stride,
                int reach) {
  const auto at = [&](int i) { return static_cast<std::size_t>(i) * stride; };
  int next = 0, last = -1 - reach;  // the last one set, before next
  for (int i = 0; i < count; ++i) {
    for (; next < count && next <= i + reach; ++next)
      if (in[at(next)] != 0) last = next;
    out[at(i)] = last >= i - reach ? 1 : 0;
  }
}

std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& mask, const ColumnCells& cells,
                                  int reach) {
  if (reach == 0) return mask;
  std::vector<std::uint8_t> rows(mask.size()), all(mask.size());
  for (int y = 0; y < cells.count; ++y)
    widen_line(&mask[cells.index(0, y)], &rows[cells.index(0, y)], cells.count, 1, reach);
  for (int x = 0; x < cells.count; ++x)
    widen_line(&rows[cells.index(x, 0)], &all[cells.index(x, 0)], cells.count, cells.index(0, 1),
               reach);
  return all;
}

std::vector<std::uint8_t> coarser(const std::vector<std::uint8_t>& mask, const ColumnCells& fine,
                                  const ColumnCells& coarse) {
  std::vector<std::uint8_t> result(coarse.all(), 0);
  const auto of = [&](int cell) {
    return ((cell - fine.count / 2) >> (coarse.shift - fine.shift)) + coarse.count / 2;
  };
  for (int y = 0; y < fine.count; ++y)
    for (int x = 0; x < fine.count; ++x)
      if (mask[fine.index(x, y)] != 0) result[coarse.index(of(x), of(y))] = 1;
  return result;
}

/// Tells which triangles may lie in filled columns. Small ones with none around them are passed
/// over, and nearly all are so.
class NearColumns {
 public:
  NearColumns(const NormalizedShape& shape, const ColumnCells& cells,
              const std::array<std::vector<std::uint8_t>, 3>& filled)
      : corners_(shape.x.size()) {
    const std::array around{widened(filled[0], cells, kReach), widened(filled[1], cells, kReach),
                            widened(filled[2], cells, kReach)};
    const auto x = cells_along(shape.x, cells), y = cells_along(shape.y, cells),
               z = cells_along(shape.z, cells);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::uint64_t near = around[0][cells.index(y[i], z[i])] |
                                 around[1][cells.index(z[i], x[i])] << 1 |
                                 around[2][cells.index(x[i], y[i])] << 2;
      corners_[i] = near << (3 * kField) | static_cast<std::uint64_t>(z[i]) << (2 * kField) |
                    static_cast<std::uint64_t>(y[i]) << kField | static_cast<std::uint64_t>(x[i]);
    }
  }

  /// The axes along which a triangle may lie in a filled column, as bits.
  unsigned axes(const Triangle& t) const {
    const std::uint64_t a = corners_[t[0]];
    if (!is_close(a, corners_[t[1]]) || !is_close(a, corners_[t[2]])) return 7;
    return static_cast<unsigned>(a >> (3 * kField));
  }

 private:
  static constexpr int kField = 16, kReach = 2;

  /// Whether no coordinate of the cells differs by more than kReach; all three at once.
  static bool is_close(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kEach = 0x0001'0001'0001, kAbove = 0x8000 * kEach;
    // A field holds 0x8000 to 0x8003 for -1 to 2; none borrows from the next.
    const std::uint64_t apart = (a | kAbove) - (b & 0xffff * kEach) + kEach;
    return ((apart ^ kAbove) & 0xfffc * kEach) == 0;
  }

  std::vector<std::uint64_t> corners_;  // their three cells, and the axes with columns around
};

/// The cells that a triangle lies in, seen along an axis.
struct CellRange {
  int x0, x1, y0, y1;

  CellRange(const LatticeTriangle& t, std::size_t axis, const ColumnCells& cells) {
    const auto range = [&](std::size_t k) {
      const auto [low, high] = std::minmax({t[0][k], t[1][k], t[2][k]});
      return std::pair(cells.of(low), cells.of(high));
    };
    std::tie(x0, x1) = range((axis + 1) % 3);
    std::tie(y0, y1) = range((axis + 2) % 3);
  }
  bool is_small() const { return x1 - x0 < kWidest && y1 - y0 < kWidest; }
};

/// Calls visit(cell) for the cells of a range that are filled.
template <class Visit>
void for_each_filled(const CellRange& range, const ColumnCells& cells,
                     const std::vector<std::uint8_t>& filled, Visit visit) {
  for (int y = range.y0; y <= range.y1; ++y)
    for (int x = range.x0; x <= range.x1; ++x)
      if (const std::size_t cell = cells.index(x, y); filled[cell] != 0) visit(cell);
}

}  // namespace

LatticePoint snap_to_lattice(const Vec3& p) {
  const auto on_lattice = [](double v) {
    return static_cast<std::int32_t>(
        std::llrint(std::clamp(v, -double{kMost}, double{kMost}) * double{kLatticeSteps}));
  };
  return {on_lattice(p.x), on_lattice(p.y), on_lattice(p.z)};
}

ColumnCells ColumnCells::of_size(int shift) {
  const auto most = static_cast<int>(double{kMost} * double{kLatticeSteps}) + 1;
  return {shift, 2 * ((most >> shift) + 1)};
}

SurfaceColumns::SurfaceColumns(const NormalizedShape& shape) : shape_(shape) {
  for (int shift = finest_shift(shape.triangles.size());; shift += kCoarser) {
    levels_.push_back({ColumnCells::of_size(shift), {}, {}, {}});
    if (shift >= kCoarsest) break;
  }
  asked_.fill(Mask(finest().all(), 0));
  levels_.front().filled = asked_;
}

void SurfaceColumns::cover(std::span<const LatticePoint> points) {
  bool is_missing = false;
  for (const auto& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t cell =
          finest().index(finest().of(p[(axis + 1) % 3]), finest().of(p[(axis + 2) % 3]));
      asked_[axis][cell] = 1;
      if (levels_.front().filled[axis][cell] == 0) is_missing = true;
    }
  }
  if (!is_missing) return;
  fill();
  margin_ = std::max(2 * margin_, kMargin);  // so that few fillings reach everything
}

void SurfaceColumns::fill() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    levels_.front().filled[axis] = widened(asked_[axis], finest(), margin_);
    for (std::size_t l = 1; l < levels_.size(); ++l)
      levels_[l].filled[axis] =
          coarser(levels_[l - 1].filled[axis], levels_[l - 1].cells, levels_[l].cells);
  }
  gather_triangles();
  for (auto& level : levels_)
    for (std::size_t axis = 0; axis < 3; ++axis) sort_into(level, axis);
}

void SurfaceColumns::gather_triangles() {
  triangles_.clear();
  level_of_.clear();
  const NearColumns near(shape_, finest(), levels_.front().filled);
  for (const auto& t : shape_.triangles) {
    const unsigned axes = near.axes(t);
    if (axes == 0) continue;
    const LatticeTriangle corners{snap_to_lattice(corner(shape_, t[0])),
                                  snap_to_lattice(corner(shape_, t[1])),
                                  snap_to_lattice(corner(shape_, t[2]))};
    triangles_.push_back(corners);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::uint8_t level = 0;
      while (!CellRange(corners, axis, levels_[level].cells).is_small()) ++level;
      level_of_.push_back((axes >> axis & 1) != 0 ? level : kNowhere);
    }
  }
}

void SurfaceColumns::sort_into(Level& level, std::size_t axis) {
  auto& start = level.start[axis];
  auto& list = level.triangle[axis];
  const auto number = static_cast<std::size_t>(&level - levels_.data());
  const auto for_each_entry = [&](auto visit) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (level_of_[3 * i + axis] != number) continue;
      for_each_filled(CellRange(triangles_[i], axis, level.cells), level.cells, level.filled[axis],
                      [&](std::size_t cell) { visit(cell, static_cast<std::uint32_t>(i)); });
    }
  };
  // Ends first, counted down to the starts.
  start.assign(level.cells.all() + 1, 0);
  for_each_entry([&](std::size_t cell, std::uint32_t) { ++start[cell]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  list.resize(start.back());
  for_each_entry([&](std::size_t cell, std::uint32_t i) { list[--start[cell]] = i; });
}

}  // namespace marrow
