#include <algorithm>
#include <vector>

#include "elastic_line_detail.hpp"
#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr double kStiffness = 0.5;         // radii: bends shorter than this are ironed out
constexpr double kLeastStiffness = 0.004;  // of the diagonal, in place of a smaller radius
constexpr double kMostStep = 0.5;          // radii in one round, where the way is blocked
constexpr double kJointWeight = 0.02;
constexpr double kBall = 0.9;   // radii of a joint: so far the walls are those of all its limbs
constexpr double kClear = 1.3;  // radii of a joint: from here on they are the limb's own
constexpr double kLeastHold = 0.02;  // of what the walls in a joint say
constexpr double kLeafWeight = 4;    // along the line

/// A point on its way. It may go as far as the sections that it has seen are wide, or as its ball
/// in the silhouettes.
struct Travel {
  Vec3 start;
  double width = 0;
  Vec3 ball;  ///< the centre: where it was found
};

double tangent_reach(const LinePoint& p, const SurfaceProbe& probe) {
  return std::max(0.75 * p.radius, 0.002 * probe.diagonal());
}

double stiffness_of(const LinePoint& p, double diagonal) {
  const double bend = kStiffness * std::max(p.radius, kLeastStiffness * diagonal);
  return bend * bend * bend * bend;
}

void measure(LinePoint& p, const SurfaceProbe& probe) {
  p.most = p.radius = probe.radius(p.position, p.most);
}

/// 0 in the ball of a joint, where the walls are those of other limbs too; 1 clear of it.
double aloneness(const BranchLine& line, std::size_t i) {
  double result = 1;
  for (const std::size_t end : {std::size_t{0}, line.size() - 1}) {
    if (!line.is_joint(end)) continue;
    const LinePoint& joint = line.points[end];
    const double share = distance(line.points[i].position, joint.position) / joint.radius;
    result = std::min(result, std::clamp((share - kBall) / (kClear - kBall), kLeastHold, 1.0));
  }
  return result;
}

/// What a point of a line is drawn by; sets its radius to what it sees. A point that sees its
/// section may go to its middle.
Hold hold_of(BranchLine& line, std::size_t i, const SurfaceProbe& probe, double& width) {
  LinePoint& p = line.points[i];
  const Vec3 tangent = tangent_at(line, i, tangent_reach(p, probe));
  if (line.is_joint(i) || tangent == Vec3{})
    return {p.position, scaled_identity(kJointWeight), stiffness_of(p, probe.diagonal())};
  const Walls walls = probe.walls_across(p.position, tangent, p.seen);
  if (walls.count > 0) p.most = p.radius = walls.nearest;  // near enough, and sooner known
  const Section section = probe.section(p.position, tangent, walls, p.radius);
  width = std::max(width, section.half_width);
  const double along = line.is_leaf(i) ? kLeafWeight : 0;  // or the line would straighten there
  const Symmetric3 weight = section.weight + outer_square(tangent) * along;
  return {section.centre, weight * aloneness(line, i), stiffness_of(p, probe.diagonal())};
}

/// What the points of a line are drawn by; `travels` of those that see their section get longer.
std::vector<Hold> holds_of(BranchLine& line, const SurfaceProbe& probe,
                           std::vector<Travel>& travels) {
  for (const std::size_t end : {std::size_t{0}, line.size() - 1})
    if (line.is_joint(end)) measure(line.points[end], probe);
  std::vector<Hold> holds;
  for (std::size_t i = 0; i < line.size(); ++i)
    holds.push_back(hold_of(line, i, probe, travels[i].width));
  return holds;
}

/// `to`, but no farther than `most` from `from`.
Vec3 no_farther(const Vec3& from, const Vec3& to, double most) {
  const double way = distance(from, to);
  return way <= most ? to : from + (to - from) * (most / way);
}

/// How far a point may go that wants to go so far; the silhouettes are asked where it matters.
double leash_of(const Travel& travel, double way, const SurfaceProbe& probe) {
  return way <= travel.width ? travel.width : std::max(travel.width, probe.hull(travel.ball));
}

void move(LinePoint& p, const Vec3& place, const Travel& travel, const SurfaceProbe& probe) {
  const double leash = leash_of(travel, distance(travel.start, place), probe);
  const Vec3 to = no_farther(travel.start, place, leash);
  const double most = kMostStep * p.radius;
  const bool is_far = distance(p.position, to) > most && probe.is_blocked(p.position, to);
  const Vec3 reached = is_far ? no_farther(p.position, to, most) : to;
  p.most += distance(p.position, reached);
  p.position = reached;
}

/// Moves a point that lies outside the surface into the limb beside it.
void bring_inside(LinePoint& p, Travel& travel, const SurfaceProbe& probe) {
  if (!probe.is_outside(p.position)) return;
  const auto inside = probe.inside_near(p.position);
  if (!inside) return;
  p.position = *inside;
  p.most = SurfaceProbe::kFar;
  travel.start = p.position;
}

}  // namespace

LinePoint measured(const Vec3& p, const SurfaceProbe& probe, double most) {
  LinePoint result{.position = p, .most = most};
  measure(result, probe);
  return result;
}

void measure(BranchLine& line, const SurfaceProbe& probe) {
  for (LinePoint& p : line.points) measure(p, probe);
}

void recentre(std::vector<BranchLine>& lines, const SurfaceProbe& probe, int rounds) {
  std::vector<std::vector<Travel>> travels;
  for (BranchLine& line : lines) {
    auto& of_line = travels.emplace_back();
    for (LinePoint& p : line.points) {
      of_line.push_back({p.position, 0, p.position});
      bring_inside(p, of_line.back(), probe);
    }
  }
  for (int round = 0; round < rounds; ++round) {
    Holds holds;
    for (std::size_t l = 0; l < lines.size(); ++l)
      holds.push_back(holds_of(lines[l], probe, travels[l]));
    const auto places = relax(lines, holds);
    for (std::size_t l = 0; l < lines.size(); ++l)
      for (std::size_t i = 0; i < lines[l].size(); ++i)
        move(lines[l].points[i], places[l][i], travels[l][i], probe);
  }
}

void measure_sections(BranchLine& line, const SurfaceProbe& probe) {
  constexpr double kMost = 1.5;  // radii
  for (std::size_t i = 0; i < line.size(); ++i) {
    LinePoint& p = line.points[i];
    p.section_radius = p.radius;
    const Vec3 tangent = tangent_at(line, i, tangent_reach(p, probe));
    if (line.is_joint(i) || tangent == Vec3{}) continue;
    const Walls walls = probe.walls_across(p.position, tangent, p.seen);
    const Section section = probe.section(p.position, tangent, walls, p.radius);
    p.section_radius = std::clamp(section.half_width, p.radius, kMost * p.radius);
  }
  const auto fade = [&](std::size_t joint, auto along) {
    const LinePoint end = line.points[joint];
    for (std::size_t i = joint; i < line.size(); i = along(i)) {
      LinePoint& p = line.points[i];
      const double share = distance(p.position, end.position) / end.radius;
      if (share >= 1) return;
      p.section_radius = p.radius + (p.section_radius - p.radius) * share;
    }
  };
  if (line.is_joint(0)) fade(0, [](std::size_t i) { return i + 1; });
  if (line.is_joint(line.size() - 1)) fade(line.size() - 1, [](std::size_t i) { return i - 1; });
}

}  // namespace marrow
