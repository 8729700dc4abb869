#include <marrow/surface_sides.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "surface_columns_detail.hpp"

namespace marrow {

namespace {

constexpr double kNoSurface = 4;

/// A triangle seen along an axis, counter-clockwise, and a line along it.
struct Crossing {
  std::int64_t beyond = 0;  ///< times `area`: from the point to the triangle, along the axis
  std::int64_t area = 0;    ///< twice
  int sign = 0;             ///< 0 where the line does not meet the triangle
};

/// Where the line along `axis` through a point meets a triangle. A line through an edge meets the
/// triangle on one side of it only, so that a closed surface is crossed exactly once there.
Crossing crossing(const LatticeTriangle& t, const LatticePoint& p, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto at = [&](std::size_t i, std::size_t k) { return std::int64_t{t[i][k]} - p[k]; };
  // Twice the areas between the point and the edges, each with the corner across from it.
  const auto part = [&](std::size_t a, std::size_t b) {
    return at(a, u) * at(b, v) - at(b, u) * at(a, v);
  };
  const std::array parts{part(1, 2), part(2, 0), part(0, 1)};
  const std::int64_t any = parts[0] | parts[1] | parts[2];
  const std::int64_t area = parts[0] + parts[1] + parts[2];
  if ((any < 0 && (parts[0] > 0 || parts[1] > 0 || parts[2] > 0)) || area == 0) return {};
  const std::int64_t turn = area < 0 ? -1 : 1;
  Crossing c{0, turn * area, static_cast<int>(turn)};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    const std::int64_t du = turn * (at(b, u) - at(a, u)), dv = turn * (at(b, v) - at(a, v));
    if (parts[i] == 0 && !(dv < 0 || (dv == 0 && du > 0))) return {};
    c.beyond += turn * parts[i] * at(i, axis);
  }
  return c;
}

/// Crossings of one line through a point.
struct LineCount {
  int before = 0, total = 0;
  double nearest = kNoSurface;

  void add(const Crossing& c) {
    total += c.sign;
    if (c.beyond < 0) before += c.sign;
    const double away =
        std::abs(static_cast<double>(c.beyond)) / static_cast<double>(c.area) / kLatticeSteps;
    nearest = std::min(nearest, away);
  }
};

PointSide side_of(const LatticePoint& p, const SurfaceColumns& surface) {
  PointSide result{Side::Unknown, kNoSurface};
  int inside = 0, outside = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LineCount along;
    surface.for_each_near(p, axis, [&](const LatticeTriangle& t) {
      if (const Crossing c = crossing(t, p, axis); c.sign != 0) along.add(c);
    });
    result.clearance = std::min(result.clearance, along.nearest);
    if (along.total == 0) ++(along.before == 0 ? outside : inside);
  }
  if (inside > 0 && outside == 0) result.side = Side::Inside;
  if (outside > 0 && inside == 0) result.side = Side::Outside;
  return result;
}

}  // namespace

SurfaceSides::SurfaceSides(const NormalizedShape& shape)
    : shape_(shape), columns_(std::make_unique<SurfaceColumns>(shape)) {}
SurfaceSides::~SurfaceSides() = default;

std::vector<PointSide> SurfaceSides::of(std::span<const Vec3> points) {
  std::vector<LatticePoint> snapped;
  snapped.reserve(points.size());
  for (const auto& p : points) snapped.push_back(snap_to_lattice(p));
  columns_->cover(snapped);
  std::vector<PointSide> sides;
  sides.reserve(points.size());
  for (const auto& p : snapped) sides.push_back(side_of(p, *columns_));
  return sides;
}

}  // namespace marrow
