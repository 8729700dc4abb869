// A skeleton taken apart into lines that can be sampled anew, and put together again.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/surface_scene.hpp>

#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace marrow {

/// What the rays across a line met last, each in its turn.
using SeenWalls = std::array<std::optional<SurfaceHit>, 8>;

/// One point of a line.
struct LinePoint {
  Vec3 position;
  double radius = 0;                                      ///< of the inscribed ball
  double section_radius = 0;                              ///< mean half width of the section
  double most = std::numeric_limits<double>::infinity();  ///< what the radius is at most
  SeenWalls seen{};  ///< from here, or from where the point was before
};

/// A branch: its points from end to end. A ring has no end, and no point twice.
struct BranchLine {
  std::vector<LinePoint> points;
  bool is_ring = false;
  bool starts_at_leaf = false, ends_at_leaf = false;
  NodeId start = 0, end = 0;    ///< nodes of the skeleton; of a ring both are its first point
  std::size_t least_edges = 1;  ///< so that no two branches become one edge

  std::size_t size() const { return points.size(); }
  std::size_t edge_count() const { return is_ring ? size() : size() - 1; }
  std::size_t after(std::size_t i) const { return is_ring ? (i + 1) % size() : i + 1; }
  std::size_t before(std::size_t i) const { return is_ring ? (i + size() - 1) % size() : i - 1; }
  double edge_length(std::size_t e) const {
    return distance(points[e].position, points[after(e)].position);
  }
  bool is_leaf(std::size_t i) const {
    return !is_ring && ((i == 0 && starts_at_leaf) || (i + 1 == size() && ends_at_leaf));
  }
  /// Whether the point is an end that other lines share.
  bool is_joint(std::size_t i) const {
    return !is_ring && ((i == 0 && !starts_at_leaf) || (i + 1 == size() && !ends_at_leaf));
  }
};

/// The branches of a skeleton. Nodes without an edge are in none.
std::vector<BranchLine> lines_of(const CurveSkeleton& skeleton);

/// The same line with points at steps of so many radii, but `least` to `most`.
BranchLine resampled(const BranchLine& line, double radii, double least, double most);

/// The place `reach` away from point `i` along the line, as far as the line goes.
Vec3 place_along(const BranchLine& line, std::size_t i, double reach, bool forwards);

/// Unit vector of the way that led to a point: the chord over `reach` behind it. Zero where the
/// line has no length there.
Vec3 heading_at(const BranchLine& line, std::size_t i, double reach);

/// Unit vector along the line at a point: the chord over `reach` to either side, as far as the line
/// goes. Zero where the line has no length.
Vec3 tangent_at(const BranchLine& line, std::size_t i, double reach);

/// The lines put together at the joints of the skeleton that they were taken from.
CurveSkeleton assemble(const CurveSkeleton& skeleton, const std::vector<BranchLine>& lines);

}  // namespace marrow
