#include <marrow/surface_sides.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace marrow {

namespace {

constexpr double kLattice = 1 << 18;  // steps to a unit: products of three coordinates fit 64 bits
constexpr float kMost = 1.01F;        // of a coordinate
constexpr double kNoSurface = 4;

using LatticePoint = std::array<std::int64_t, 3>;

LatticePoint snap(const Vec3& p) {
  const auto on_lattice = [](double v) {
    return static_cast<std::int64_t>(
        std::llrint(std::clamp(v, -double{kMost}, double{kMost}) * kLattice));
  };
  return {on_lattice(p.x), on_lattice(p.y), on_lattice(p.z)};
}

/// Square cells of 2^shift lattice steps over the whole frame.
struct Cells {
  int shift = 11, count = 260;  // along a side: coordinates run from -1 to 1 and a little more

  int of(std::int64_t coordinate) const {
    return std::clamp(static_cast<int>(coordinate >> shift) + count / 2, 0, count - 1);
  }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * count + x); }
  std::size_t all() const { return index(0, count); }
};

constexpr Cells kCells;  // for finding the points under a triangle

/// As fine as the triangles, as far as their number tells.
Cells cells_for(std::size_t triangles) {
  Cells cells{12, 130};
  for (std::size_t few = 60'000; few < triangles && cells.shift > 10; few *= 4)
    --cells.shift, cells.count *= 2;
  return cells;
}

Vec3 corner(const NormalizedShape& shape, std::size_t i) {
  return {double{shape.x[i]}, double{shape.y[i]}, double{shape.z[i]}};
}

/// The lines through points along one axis, sorted into the cells of the plane across it. Points
/// often stand in columns, so that there are fewer lines than points.
class Lines {
 public:
  struct Line {
    std::int64_t u, v;
    std::uint32_t first, count;  // of the points on it
  };

  Lines(std::span<const LatticePoint> points, std::size_t along)
      : axis_(along), start_(kCells.all() + 1, 0), point_(points.size()) {
    const std::size_t u = (along + 1) % 3, v = (along + 2) % 3;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // by cell, then by line
    order.reserve(points.size());
    for (const auto& p : points) {
      const std::uint64_t cell = kCells.index(kCells.of(p[u]), kCells.of(p[v]));
      order.push_back(
          {cell << 40 | place(p[u]) << 20 | place(p[v]), static_cast<std::uint32_t>(order.size())});
    }
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      point_[i] = order[i].second;
      if (i == 0 || order[i].first != order[i - 1].first) {
        const LatticePoint& p = points[point_[i]];
        lines_.push_back({p[u], p[v], i, 0});
        ++start_[(order[i].first >> 40) + 1];
      }
      ++lines_.back().count;
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
  }

  std::size_t axis() const { return axis_; }

  /// The lines in the cells from (x0, y) to (x1, y).
  std::span<const Line> row(int y, int x0, int x1) const {
    const std::uint32_t first = start_[kCells.index(x0, y)], end = start_[kCells.index(x1, y) + 1];
    return std::span(lines_).subspan(first, end - first);
  }
  std::span<const std::uint32_t> points_on(const Line& line) const {
    return std::span(point_).subspan(line.first, line.count);
  }

 private:
  static std::uint64_t place(std::int64_t coordinate) {
    return static_cast<std::uint64_t>(coordinate + (1 << 19));
  }

  std::size_t axis_;
  std::vector<std::uint32_t> start_, point_;
  std::vector<Line> lines_;
};

/// The cells of all coordinates along one axis: snap(), many at once.
std::vector<std::int32_t> cells_along(std::span<const float> coordinates, const Cells& cells) {
  constexpr float kSteps = 1 << 18, kRounding = 0x1.8p23f;  // from 2^23 on floats are integers
  std::vector<std::int32_t> result(coordinates.size());
  const int shift = cells.shift, middle = cells.count / 2;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const float at = std::min(std::max(coordinates[i], -kMost), kMost) * kSteps + kRounding;
    const int steps = std::bit_cast<std::int32_t>(at) - std::bit_cast<std::int32_t>(kRounding);
    result[i] = (steps >> shift) + middle;
  }
  return result;
}

/// Tells which triangles a line through one of the points may meet. Small ones with no point in
/// the cells around it are passed over, and nearly all are so.
class NearPoints {
 public:
  NearPoints(const NormalizedShape& shape, std::span<const LatticePoint> points)
      : cells_(cells_for(shape.triangles.size())), corners_(shape.x.size()) {
    const std::array around{cells_around(points, 0), cells_around(points, 1),
                            cells_around(points, 2)};
    const auto x = cells_along(shape.x, cells_), y = cells_along(shape.y, cells_),
               z = cells_along(shape.z, cells_);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::uint64_t near = around[0][cells_.index(y[i], z[i])] |
                                 around[1][cells_.index(z[i], x[i])] << 1 |
                                 around[2][cells_.index(x[i], y[i])] << 2;
      corners_[i] = near << (3 * kField) | static_cast<std::uint64_t>(z[i]) << (2 * kField) |
                    static_cast<std::uint64_t>(y[i]) << kField | static_cast<std::uint64_t>(x[i]);
    }
  }

  /// The axes along which a line may meet a triangle, as bits.
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

  /// Cells across one axis with a point within kReach cells along either side.
  std::vector<std::uint8_t> cells_around(std::span<const LatticePoint> points,
                                         std::size_t axis) const {
    std::vector<std::uint8_t> around(cells_.all(), 0);
    const auto reach = [&](std::int64_t coordinate) {
      const int cell = cells_.of(coordinate);
      return std::pair(std::max(cell - kReach, 0), std::min(cell + kReach, cells_.count - 1));
    };
    for (const auto& p : points) {
      const auto [x0, x1] = reach(p[(axis + 1) % 3]);
      const auto [y0, y1] = reach(p[(axis + 2) % 3]);
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) around[cells_.index(x, y)] = 1;
    }
    return around;
  }

  Cells cells_;
  std::vector<std::uint64_t> corners_;  // their three cells, and the axes with a point around
};

/// A triangle seen along `axis`, counter-clockwise; crossings with lines along the axis.
struct ProjectedTriangle {
  std::array<LatticePoint, 3> corner;
  std::size_t axis, u, v;
  std::int64_t area = 0;  // twice
  int sign = 1;

  ProjectedTriangle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                    std::size_t along)
      : corner{a, b, c}, axis(along), u((along + 1) % 3), v((along + 2) % 3) {
    area = (b[u] - a[u]) * (c[v] - a[v]) - (c[u] - a[u]) * (b[v] - a[v]);
    if (area < 0) std::swap(corner[1], corner[2]), area = -area, sign = -1;
  }

  /// Twice the area times the coordinate along the axis where a line meets the triangle. A line
  /// through an edge meets the triangle on one side of it only, so that a closed surface is crossed
  /// exactly once there.
  bool meets(const Lines::Line& line, std::int64_t& depth) const {
    depth = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const LatticePoint &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
      const std::int64_t du = b[u] - a[u], dv = b[v] - a[v];
      const std::int64_t e = du * (line.v - a[v]) - dv * (line.u - a[u]);
      if (e < 0 || (e == 0 && !(dv < 0 || (dv == 0 && du > 0)))) return false;
      depth += e * corner[i][axis];
    }
    return true;
  }
};

/// Crossings of one line through a point.
struct LineCount {
  int before = 0, total = 0;
  double nearest = kNoSurface;

  void add(int sign, std::int64_t beyond, std::int64_t area) {
    total += sign;
    if (beyond < 0) before += sign;
    const double away =
        std::abs(static_cast<double>(beyond)) / static_cast<double>(area) / kLattice;
    nearest = std::min(nearest, away);
  }
};

/// The corners of a triangle on the lattice, and the cells that it lies in along each coordinate.
struct SnappedTriangle {
  std::array<LatticePoint, 3> corner;
  std::array<int, 3> low, high;

  SnappedTriangle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
      : corner{a, b, c} {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = kCells.of(std::min({a[k], b[k], c[k]}));
      high[k] = kCells.of(std::max({a[k], b[k], c[k]}));
    }
  }
};

/// Adds the crossings of a triangle with the lines through the points along one axis.
void add_crossings(const SnappedTriangle& t, std::span<const LatticePoint> points,
                   const Lines& lines, std::vector<LineCount>& counts) {
  const std::size_t axis = lines.axis(), u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::optional<ProjectedTriangle> triangle;
  for (int y = t.low[v]; y <= t.high[v]; ++y) {
    for (const auto& line : lines.row(y, t.low[u], t.high[u])) {
      if (!triangle) triangle.emplace(t.corner[0], t.corner[1], t.corner[2], axis);
      if (triangle->area == 0) return;
      std::int64_t depth = 0;
      if (!triangle->meets(line, depth)) continue;
      for (const std::uint32_t i : lines.points_on(line))
        counts[i].add(triangle->sign, depth - points[i][axis] * triangle->area, triangle->area);
    }
  }
}

}  // namespace

std::vector<PointSide> SurfaceSides::of(std::span<const Vec3> points) const {
  std::vector<PointSide> sides(points.size(), {Side::Unknown, kNoSurface});
  if (points.empty()) return sides;
  std::vector<LatticePoint> snapped;
  snapped.reserve(points.size());
  for (const auto& p : points) snapped.push_back(snap(p));
  const std::array lines{Lines(snapped, 0), Lines(snapped, 1), Lines(snapped, 2)};
  std::array<std::vector<LineCount>, 3> counts;
  counts.fill(std::vector<LineCount>(points.size()));
  const NearPoints near(shape_, snapped);
  for (const auto& t : shape_.triangles) {
    const unsigned axes = near.axes(t);
    if (axes == 0) continue;
    const SnappedTriangle triangle(snap(corner(shape_, t[0])), snap(corner(shape_, t[1])),
                                   snap(corner(shape_, t[2])));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((axes >> axis & 1) != 0) add_crossings(triangle, snapped, lines[axis], counts[axis]);
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    int inside = 0, outside = 0;
    for (const auto& along : counts) {
      sides[i].clearance = std::min(sides[i].clearance, along[i].nearest);
      if (along[i].total == 0) ++(along[i].before == 0 ? outside : inside);
    }
    if (inside > 0 && outside == 0) sides[i].side = Side::Inside;
    if (outside > 0 && inside == 0) sides[i].side = Side::Outside;
  }
  return sides;
}

}  // namespace marrow
