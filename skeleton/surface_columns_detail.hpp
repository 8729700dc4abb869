// The triangles of a surface sorted into columns along the three axes, for lines through points.
#pragma once

#include <marrow/normalization.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace marrow {

constexpr std::int64_t kLatticeSteps = 1 << 18;  // to a unit: products of three coordinates fit

/// Coordinates in steps of the lattice.
using LatticePoint = std::array<std::int32_t, 3>;
using LatticeTriangle = std::array<LatticePoint, 3>;

LatticePoint snap_to_lattice(const Vec3& p);

/// Square cells of 2^shift lattice steps over the whole frame.
struct ColumnCells {
  int shift = 0, count = 0;  // along a side: coordinates run from -1 to 1 and a little more

  /// Cells of 2^shift steps.
  static ColumnCells of_size(int shift);

  int of(std::int32_t coordinate) const { return (coordinate >> shift) + count / 2; }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * count + x); }
  std::size_t all() const { return index(0, count); }
};

/// Only the columns around the points asked for are filled, for a skeleton goes through few of them
/// and a surface may be large.
class SurfaceColumns {
 public:
  /// `shape` must outlive this.
  explicit SurfaceColumns(const NormalizedShape& shape);

  /// Fills the columns that lines through `points` run along, unless they are.
  void cover(std::span<const LatticePoint> points);

  /// Calls visit(triangle) for all triangles that the line along `axis` through a point may meet,
  /// and some others. cover() must have had the point.
  template <class Visit>
  void for_each_near(const LatticePoint& p, std::size_t axis, Visit visit) const {
    const std::int32_t u = p[(axis + 1) % 3], v = p[(axis + 2) % 3];
    for (const auto& level : levels_) {
      const auto& list = level.list[axis];
      if (list.empty()) continue;
      const std::size_t cell = level.cells.index(level.cells.of(u), level.cells.of(v));
      const auto [first, end] = level.part[axis][cell];
      for (std::uint32_t i = first; i < end; ++i)
        if (list[i].box.may_hold(u, v)) visit(triangles_[list[i].triangle]);
    }
  }

 private:
  using Mask = std::vector<std::uint8_t>;  // over the cells across one axis

  /// What a triangle covers seen along an axis, in coarser steps.
  struct Box {
    std::int16_t low_u = 0, high_u = 0, low_v = 0, high_v = 0;

    bool may_hold(std::int32_t u, std::int32_t v) const {
      u >>= kShift, v >>= kShift;
      return ((u - low_u) | (high_u - u) | (v - low_v) | (high_v - v)) >= 0;
    }

    static constexpr int kShift = 4;
  };

  /// Most triangles of a column do not meet the line, and their boxes tell: these lie side by side.
  struct Listed {
    Box box;
    std::uint32_t triangle = 0;
  };

  struct Entry {
    std::uint32_t cell;
    Listed listed;
  };

  /// Part of a list.
  struct Part {
    std::uint32_t first = kNowhere, end = 0;

    static constexpr std::uint32_t kNowhere = ~0u;
  };

  /// Triangles of about the size of its cells, and smaller ones in the finest.
  struct Level {
    ColumnCells cells;
    std::array<Mask, 3> filled, fresh;          // of these, what was not before
    std::array<std::vector<Entry>, 3> entries;  // of the fresh cells
    std::array<std::vector<Part>, 3> part;      // of the list, for every cell
    std::array<std::vector<Listed>, 3> list;

    /// Adds cells to the filled ones.
    void fill(std::size_t axis, const Mask& wanted);
    /// Brings the entries to the end of the list.
    void sort(std::size_t axis);
  };

  void fill();
  void start();
  void gather_triangles();
  void add(const LatticeTriangle& triangle, unsigned axes);
  const ColumnCells& finest() const { return levels_.front().cells; }

  const NormalizedShape& shape_;
  std::vector<LatticePoint> corners_;
  int margin_ = 0;    // cells filled around those asked for
  int fillings_ = 0;  // so far
  std::array<Mask, 3> asked_;
  std::vector<Level> levels_;  // the finest first, each four times as coarse as the one before
  std::vector<LatticeTriangle> triangles_;
};

}  // namespace marrow
