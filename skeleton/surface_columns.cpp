#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "surface_columns_detail.hpp"

namespace marrow {

namespace {

constexpr float kMost = 1.01F;               // of a coordinate
constexpr int kMargin = 2;                   // cells around, when columns are filled again
constexpr int kFewFillings = 8;              // then the margin grows, so that not many more follow
constexpr int kCoarsest = 18, kCoarser = 2;  // shifts
constexpr int kWidest = 4;                   // cells along a side of what a level takes

/// As fine as the triangles, as far as their number tells.
int finest_shift(std::size_t triangles) {
  int shift = 14;
  for (std::size_t few = 4'000; few < triangles && shift > 10; few *= 4) --shift;
  return shift;
}

/// All corners: snap_to_lattice(), many at once.
std::vector<LatticePoint> snapped_corners(const NormalizedShape& shape) {
  constexpr float kSteps = kLatticeSteps, kRounding = 0x1.8p23f;  // above 2^23 floats are integers
  std::vector<LatticePoint> result(shape.x.size());
  const auto snap = [=](float coordinate) {
    const float at = std::min(std::max(coordinate, -kMost), kMost) * kSteps + kRounding;
    return std::bit_cast<std::int32_t>(at) - std::bit_cast<std::int32_t>(kRounding);
  };
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {snap(shape.x[i]), snap(shape.y[i]), snap(shape.z[i])};
  return result;
}

/// The cells with one of `mask` up to `reach` cells away along either side.
std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& mask, const ColumnCells& cells,
                                  int reach) {
  if (reach == 0) return mask;
  const auto count = static_cast<std::size_t>(cells.count),
             around = static_cast<std::size_t>(reach);
  std::vector<std::uint8_t> rows(mask.size(), 0), all(mask.size(), 0),
      padded(count + 2 * around, 0);
  const auto add = [count](const std::uint8_t* some, std::uint8_t* sum) {
    for (std::size_t x = 0; x < count; ++x) sum[x] |= some[x];
  };
  for (std::size_t row = 0; row < mask.size(); row += count) {
    if (std::find(&mask[row], &mask[row] + count, 1) == &mask[row] + count) continue;
    std::copy_n(&mask[row], count, &padded[around]);
    for (std::size_t k = 0; k <= 2 * around; ++k) add(&padded[k], &rows[row]);
    const int y = static_cast<int>(row / count);
    for (int to = std::max(y - reach, 0); to <= std::min(y + reach, cells.count - 1); ++to)
      add(&rows[row], &all[cells.index(0, to)]);
  }
  return all;
}

std::vector<std::uint8_t> coarser(const std::vector<std::uint8_t>& mask, const ColumnCells& fine,
                                  const ColumnCells& coarse) {
  std::vector<std::uint8_t> result(coarse.all(), 0);
  const auto of = [&](int cell) {
    return ((cell - fine.count / 2) >> (coarse.shift - fine.shift)) + coarse.count / 2;
  };
  for (int y = 0; y < fine.count; ++y) {
    const auto first = mask.begin() + static_cast<std::ptrdiff_t>(fine.index(0, y));
    for (auto at = first; (at = std::find(at, first + fine.count, 1)) != first + fine.count; ++at)
      result[coarse.index(of(static_cast<int>(at - first)), of(y))] = 1;
  }
  return result;
}

/// Tells which triangles may lie in filled columns. Small ones with none around them are passed
/// over, and nearly all are so.
class NearColumns {
 public:
  NearColumns(std::span<const LatticePoint> corners, const ColumnCells& cells,
              const std::array<std::vector<std::uint8_t>, 3>& filled)
      : corners_(corners.size()) {
    const std::array around{widened(filled[0], cells, kReach), widened(filled[1], cells, kReach),
                            widened(filled[2], cells, kReach)};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int x = cells.of(corners[i][0]), y = cells.of(corners[i][1]),
                z = cells.of(corners[i][2]);
      const std::uint64_t near = around[0][cells.index(y, z)] | around[1][cells.index(z, x)] << 1 |
                                 around[2][cells.index(x, y)] << 2;
      corners_[i] = near << (3 * kField) | static_cast<std::uint64_t>(z) << (2 * kField) |
                    static_cast<std::uint64_t>(y) << kField | static_cast<std::uint64_t>(x);
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

/// The box of a triangle.
struct Extent {
  LatticePoint low, high;

  explicit Extent(const LatticeTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(std::min(t[0][k], t[1][k]), t[2][k]);
      high[k] = std::max(std::max(t[0][k], t[1][k]), t[2][k]);
    }
  }
};

/// The cells that a triangle lies in, seen along an axis.
struct CellRange {
  int x0, x1, y0, y1;

  CellRange(const Extent& extent, std::size_t axis, const ColumnCells& cells)
      : x0(cells.of(extent.low[(axis + 1) % 3])),
        x1(cells.of(extent.high[(axis + 1) % 3])),
        y0(cells.of(extent.low[(axis + 2) % 3])),
        y1(cells.of(extent.high[(axis + 2) % 3])) {}

  bool is_small() const { return x1 - x0 < kWidest && y1 - y0 < kWidest; }
};

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

SurfaceColumns::SurfaceColumns(const NormalizedShape& shape) : shape_(shape) {}

void SurfaceColumns::start() {
  corners_ = snapped_corners(shape_);
  for (int shift = finest_shift(shape_.triangles.size());; shift += kCoarser) {
    levels_.push_back({ColumnCells::of_size(shift), {}, {}, {}, {}, {}});
    if (shift >= kCoarsest) break;
  }
  asked_.fill(Mask(finest().all(), 0));
  levels_.front().filled = asked_;
}

void SurfaceColumns::cover(std::span<const LatticePoint> points) {
  if (points.empty()) return;
  if (levels_.empty()) start();
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
  margin_ = fillings_++ < kFewFillings ? kMargin : 2 * margin_;
}

void SurfaceColumns::fill() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Mask wanted = widened(asked_[axis], finest(), margin_);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      if (l > 0) wanted = coarser(wanted, levels_[l - 1].cells, levels_[l].cells);
      levels_[l].fill(axis, wanted);
    }
  }
  gather_triangles();
  for (auto& level : levels_)
    for (std::size_t axis = 0; axis < 3; ++axis) level.sort(axis);
}

void SurfaceColumns::gather_triangles() {
  const NearColumns near(corners_, finest(), levels_.front().fresh);
  for (const auto& t : shape_.triangles)
    if (const unsigned axes = near.axes(t); axes != 0)
      add({corners_[t[0]], corners_[t[1]], corners_[t[2]]}, axes);
}

void SurfaceColumns::add(const LatticeTriangle& triangle, unsigned axes) {
  const auto number = static_cast<std::uint32_t>(triangles_.size());
  const Extent extent(triangle);
  const auto at = [](std::int32_t coordinate) {
    return static_cast<std::int16_t>(coordinate >> Box::kShift);
  };
  bool is_anywhere = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((axes >> axis & 1) == 0) continue;
    auto level = levels_.begin();
    CellRange range(extent, axis, level->cells);
    while (!range.is_small()) range = CellRange(extent, axis, (++level)->cells);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Box box{at(extent.low[u]), at(extent.high[u]), at(extent.low[v]), at(extent.high[v])};
    for (int y = range.y0; y <= range.y1; ++y)
      for (int x = range.x0; x <= range.x1; ++x) {
        const std::size_t cell = level->cells.index(x, y);
        if (level->fresh[axis][cell] == 0) continue;
        level->entries[axis].push_back({static_cast<std::uint32_t>(cell), {box, number}});
        is_anywhere = true;
      }
  }
  if (is_anywhere) triangles_.push_back(triangle);
}

void SurfaceColumns::Level::fill(std::size_t axis, const Mask& wanted) {
  Mask& all = filled[axis];
  all.resize(wanted.size(), 0);
  fresh[axis].resize(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    fresh[axis][i] = wanted[i] & (all[i] ^ 1);
    all[i] |= wanted[i];
  }
}

void SurfaceColumns::Level::sort(std::size_t axis) {
  auto& parts = part[axis];
  parts.resize(cells.all());
  for (const auto& e : entries[axis])
    ++parts[e.cell].end;  // fresh cells: a number until they begin
  auto next = static_cast<std::uint32_t>(list[axis].size());
  list[axis].resize(next + entries[axis].size());
  for (const auto& e : entries[axis]) {
    Part& p = parts[e.cell];
    if (p.first == Part::kNowhere) {
      p.first = next;
      next += std::exchange(p.end, next);
    }
    list[axis][p.end++] = e.listed;
  }
  entries[axis].clear();
}

}  // namespace marrow
