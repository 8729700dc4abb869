#include <marrow/surface_sides.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace marrow {

namespace {

constexpr double kLattice = 1 << 18;  // steps to a unit: products of three coordinates fit 64 bits
constexpr int kCellShift = 12;  // cells of 2^12 steps, for finding the points under a triangle
constexpr int kCells = 130;     // along a side: coordinates run from -1 to 1 and a little more
constexpr double kNoSurface = 4;

using LatticePoint = std::array<std::int64_t, 3>;

LatticePoint snap(const Vec3& p) {
  const auto on_lattice = [](double v) {
    return static_cast<std::int64_t>(std::llrint(std::clamp(v, -1.01, 1.01) * kLattice));
  };
  return {on_lattice(p.x), on_lattice(p.y), on_lattice(p.z)};
}

int cell_of(std::int64_t coordinate) {
  return std::clamp(static_cast<int>(coordinate >> kCellShift) + kCells / 2, 0, kCells - 1);
}

/// Points sorted into the cells of the plane across one axis.
class Buckets {
 public:
  Buckets(std::span<const LatticePoint> points, std::size_t u, std::size_t v)
      : start_(kCells * kCells + 1, 0), index_(points.size()) {
    for (const auto& p : points) ++start_[cell(p[u], p[v]) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    auto next = start_;
    for (std::uint32_t i = 0; i < points.size(); ++i)
      index_[next[cell(points[i][u], points[i][v])]++] = i;
  }

  std::span<const std::uint32_t> at(int x, int y) const {
    const std::size_t c = index_of(x, y);
    return std::span(index_).subspan(start_[c], start_[c + 1] - start_[c]);
  }

 private:
  static std::size_t cell(std::int64_t u, std::int64_t v) {
    return index_of(cell_of(u), cell_of(v));
  }
  static std::size_t index_of(int x, int y) {
    return static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x);
  }

  std::vector<std::uint32_t> start_, index_;
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

  /// Twice the area times the coordinate along the axis where the line through `p` meets the
  /// triangle. A line through an edge meets the triangle on one side of it only, so that a closed
  /// surface is crossed exactly once there.
  bool meets(const LatticePoint& p, std::int64_t& depth) const {
    depth = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const LatticePoint &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
      const std::int64_t du = b[u] - a[u], dv = b[v] - a[v];
      const std::int64_t e = du * (p[v] - a[v]) - dv * (p[u] - a[u]);
      if (e < 0 || (e == 0 && !(dv < 0 || (dv == 0 && du > 0)))) return false;
      depth += e * corner[i][axis];
    }
    return true;
  }

  std::pair<int, int> cells(std::size_t k) const {
    const auto [low, high] = std::minmax({corner[0][k], corner[1][k], corner[2][k]});
    return {cell_of(low), cell_of(high)};
  }
};

/// Crossings of one line through a point.
struct LineCount {
  int before = 0, total = 0;
  double nearest = kNoSurface;
};

std::vector<LineCount> count_crossings(std::span<const LatticePoint> points,
                                       std::span<const LatticePoint> corners,
                                       std::span<const Triangle> triangles, std::size_t axis) {
  const Buckets buckets(points, (axis + 1) % 3, (axis + 2) % 3);
  std::vector<LineCount> counts(points.size());
  for (const auto& t : triangles) {
    const ProjectedTriangle triangle(corners[t[0]], corners[t[1]], corners[t[2]], axis);
    if (triangle.area == 0) continue;
    const auto [x0, x1] = triangle.cells(triangle.u);
    const auto [y0, y1] = triangle.cells(triangle.v);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (const std::uint32_t i : buckets.at(x, y)) {
          std::int64_t depth = 0;
          if (!triangle.meets(points[i], depth)) continue;
          const std::int64_t beyond = depth - points[i][axis] * triangle.area;
          LineCount& count = counts[i];
          count.total += triangle.sign;
          if (beyond < 0) count.before += triangle.sign;
          count.nearest =
              std::min(count.nearest, std::abs(static_cast<double>(beyond)) /
                                          static_cast<double>(triangle.area) / kLattice);
        }
  }
  return counts;
}

}  // namespace

SurfaceSides::SurfaceSides(const NormalizedShape& shape) : triangles_(shape.triangles) {
  corners_.reserve(shape.x.size());
  for (std::size_t i = 0; i < shape.x.size(); ++i)
    corners_.push_back(snap({double{shape.x[i]}, double{shape.y[i]}, double{shape.z[i]}}));
}

std::vector<PointSide> SurfaceSides::of(std::span<const Vec3> points) const {
  std::vector<LatticePoint> snapped;
  for (const auto& p : points) snapped.push_back(snap(p));
  std::vector<int> inside(points.size(), 0), outside(points.size(), 0);
  std::vector<PointSide> sides(points.size(), {Side::Unknown, kNoSurface});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto counts = count_crossings(snapped, corners_, triangles_, axis);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      sides[i].clearance = std::min(sides[i].clearance, counts[i].nearest);
      if (counts[i].total == 0) ++(counts[i].before == 0 ? outside : inside)[i];
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (inside[i] > 0 && outside[i] == 0) sides[i].side = Side::Inside;
    if (outside[i] > 0 && inside[i] == 0) sides[i].side = Side::Outside;
  }
  return sides;
}

}  // namespace marrow
