#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr double kCornerSlope = 0.25;  // radii shrink by that, or more, into a corner
constexpr double kStraight = 0.97;     // cosine of the least turn into a corner: 14 degrees
constexpr double kBend = 0.6;          // radii that the line has begun to turn before it
constexpr double kAlike = 0.75;  // another corner is at least that far, of the way into this one
constexpr double kRoom = 3;      // radii: a way that long leads into another limb

/// The last point before the radii run down to the leaf at the end of the line.
std::size_t last_of_limb(const BranchLine& line) {
  const LinePoint& start = line.points.front();
  std::size_t last = line.size() - 1;
  double way = 0, most = line.points.back().radius;
  for (std::size_t i = line.size() - 1; i-- > 1;) {
    const LinePoint& p = line.points[i];
    way += line.edge_length(i);
    const bool is_in_joint =
        !line.starts_at_leaf && distance(p.position, start.position) < start.radius;
    if (is_in_joint || kCornerSlope * way > p.radius) break;
    const double value = p.radius - kCornerSlope * way;
    if (value > most) {
      most = value;
      last = i;
    }
  }
  return last;
}

/// Whether the line turns from its point `i` into one corner where others are alike, and the limb
/// goes nowhere.
bool turns_into_corner(const BranchLine& line, std::size_t i, const SurfaceProbe& probe) {
  const LinePoint& p = line.points[i];
  const Vec3 limb = heading_at(line, i, p.radius);
  const Vec3 out = line.points.back().position - p.position;
  const double depth = length(out);
  if (limb == Vec3{} || depth == 0) return false;
  const Vec3 corner = out / depth;
  if (dot(corner, limb) > kStraight) return false;
  const double own = probe.free_way(p.position, corner), room = kRoom * p.radius;
  if (own > room) return false;
  const double other = longest(probe.free_ways(p.position, limb), corner).length;
  return other >= kAlike * own && other <= room;
}

}  // namespace

void leave_corner(BranchLine& line, const SurfaceProbe& probe) {
  const std::size_t last = last_of_limb(line);
  if (last + 1 == line.size() || !turns_into_corner(line, last, probe)) return;
  std::size_t end = last;
  for (double way = 0; end > 0 && way < kBend * line.points[last].radius;)
    way += line.edge_length(--end);
  if (end >= line.least_edges) line.points.resize(end + 1);
}

}  // namespace marrow
