#include <algorithm>
#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr double kGap = 0.08;      // radii between the ball of a settled leaf and the limb's end
constexpr double kApproach = 0.7;  // of the gap, in one step
constexpr double kMostStep = 0.5;  // radii
constexpr double kWidest = 1.3;    // times the radius at the start: it runs into the open
constexpr double kThinnest = 0.5;  // times that radius: a toe, not the foot
constexpr double kLeastCosine = 0.70710678118654752;  // of the turn from where the limb pointed
constexpr double kAside = 2;     // radii: free way from the end of a limb that goes on
constexpr double kAlone = 0.75;  // of that way: all others
constexpr int kMostSteps = 40, kHalvings = 4;

/// The way a limb points at one of its last points.
Vec3 heading(const BranchLine& line, std::size_t i) {
  return heading_at(line, i, std::max(line.points[i].radius, 1e-3));
}

/// From the ball of a point to the wall ahead.
double gap(const LinePoint& p, const Vec3& heading, const SurfaceProbe& probe) {
  return probe.ahead(p.position, heading) - p.radius;
}

bool touches_end(const BranchLine& line, std::size_t i, const SurfaceProbe& probe) {
  const Vec3 way = heading(line, i);
  return way != Vec3{} && gap(line.points[i], way, probe) <= kGap * line.points[i].radius;
}

/// Takes points off until the one behind the leaf does not touch the end, then moves the leaf to
/// the first place that does.
void shorten(BranchLine& line, const SurfaceProbe& probe) {
  while (line.edge_count() > line.least_edges && touches_end(line, line.size() - 2, probe))
    line.points.pop_back();
  const std::size_t leaf = line.size() - 1;
  if (!touches_end(line, leaf, probe)) return;
  LinePoint behind = line.points[leaf - 1];
  if (line.size() == 2 && touches_end(line, 0, probe)) return;
  for (int k = 0; k < kHalvings; ++k) {
    const LinePoint touching = line.points[leaf];
    line.points[leaf] =
        measured((behind.position + touching.position) * 0.5, probe,
                 behind.radius + 0.5 * distance(behind.position, touching.position));
    if (touches_end(line, leaf, probe)) continue;
    behind = line.points[leaf];
    line.points[leaf] = touching;
  }
}

/// The next place on the way out of a limb, in the middle of it.
LinePoint next_place(const LinePoint& last, const Vec3& way, double step,
                     const SurfaceProbe& probe) {
  const LinePoint ahead = measured(last.position + way * step, probe, last.radius + step);
  const Vec3 off = probe.section(ahead.position, way, ahead.radius).centre - ahead.position;
  const double far = length(off), most = 0.5 * std::min(ahead.radius, step);
  const Vec3 place = ahead.position + (far > most ? off * (most / far) : off);
  return measured(place, probe, ahead.radius + std::min(far, most));
}

/// Adds points until the ball of the last one touches the end of the limb; says whether it does.
template <class IsTaken>
bool lengthen(BranchLine& line, const SurfaceProbe& probe, IsTaken is_taken) {
  const double start = line.points.back().radius;
  const Vec3 limb = heading(line, line.size() - 1);
  for (int k = 0; k < kMostSteps; ++k) {
    const LinePoint last = line.points.back();
    const Vec3 way = heading(line, line.size() - 1);
    if (way == Vec3{}) return false;
    const double left = gap(last, way, probe);
    if (left > 1) return false;  // into the open
    if (left <= kGap * last.radius) return true;
    const double step = std::min(kMostStep * last.radius, kApproach * left);
    const LinePoint next = next_place(last, way, step, probe);
    const Vec3 moved = next.position - last.position;
    const bool turns = dot(moved, limb) < kLeastCosine * length(moved);
    const bool is_odd = next.radius > kWidest * start || next.radius < kThinnest * start;
    if (turns || is_odd || is_taken(next.position)) return false;
    line.points.push_back(next);
  }
  return false;
}

/// Where a limb goes on to one side of its end, round a bend, the line follows it to its end.
template <class IsTaken>
void turn_aside(BranchLine& line, const SurfaceProbe& probe, IsTaken is_taken) {
  const LinePoint end = line.points.back();
  const Vec3 limb = heading(line, line.size() - 1);
  const std::vector<Way> ways = probe.free_ways(end.position, limb);
  const Way aside = longest(ways);
  if (aside.length < kAside * end.radius || aside.length >= SurfaceProbe::kFar) return;
  if (longest(ways, aside.direction).length > kAlone * aside.length) return;  // one of corners
  const LinePoint next = next_place(end, aside.direction, kMostStep * end.radius, probe);
  BranchLine longer{.points = {end, next}};
  if (probe.is_blocked(end.position, next.position) || !lengthen(longer, probe, is_taken)) return;
  line.points.insert(line.points.end(), longer.points.begin() + 1, longer.points.end());
}

/// Whether a place lies in a ball of a line.
bool holds(const BranchLine& line, const Vec3& p) {
  return std::any_of(line.points.begin(), line.points.end(), [&](const LinePoint& q) {
    return squared_length(q.position - p) < q.radius * q.radius;
  });
}

void turn_round(BranchLine& line) {
  std::reverse(line.points.begin(), line.points.end());
  std::swap(line.start, line.end);
  std::swap(line.starts_at_leaf, line.ends_at_leaf);
}

}  // namespace

void settle_tips(std::vector<BranchLine>& lines, const SurfaceProbe& probe) {
  for (BranchLine& line : lines) {
    const auto is_taken = [&](const Vec3& p) {
      return std::any_of(lines.begin(), lines.end(), [&](const BranchLine& other) {
        return &other != &line && holds(other, p);
      });
    };
    for (int end = 0; end < 2; ++end) {
      if (line.ends_at_leaf) {
        leave_corner(line, probe);
        shorten(line, probe);
        lengthen(line, probe, is_taken);
        turn_aside(line, probe, is_taken);
      }
      turn_round(line);
    }
  }
}

}  // namespace marrow
