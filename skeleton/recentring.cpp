#include "recentring_detail.hpp"

#include <algorithm>
#include <vector>

#include "elastic_line_detail.hpp"

namespace marrow {

namespace {

constexpr int kRounds = 3;
constexpr double kStiffness = 0.5;        // radii: bends shorter than this are ironed out
constexpr double kLeastStiffness = 0.004;  // of the diagonal, in place of a smaller radius
constexpr double kMostStep = 0.8;         // radii in one round

double tangent_reach(const BranchLine& line, std::size_t i, const SurfaceProbe& probe) {
  return std::max(0.75 * line.points[i].radius, 0.002 * probe.diagonal());
}

std::vector<Target> targets_of(const BranchLine& line, const SurfaceProbe& probe) {
  std::vector<Target> targets;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const LinePoint& p = line.points[i];
    const Vec3 tangent = tangent_at(line, i, tangent_reach(line, i, probe));
    if (line.is_fixed(i) || tangent == Vec3{}) {
      targets.push_back({p.position, scaled_identity(1)});
      continue;
    }
    const Section section = probe.section(p.position, tangent, p.radius);
    targets.push_back({section.centre, section.weight});
  }
  return targets;
}

std::vector<double> stiffness_of(const BranchLine& line, double diagonal) {
  std::vector<double> result;
  for (const LinePoint& p : line.points) {
    const double bend = kStiffness * std::max(p.radius, kLeastStiffness * diagonal);
    result.push_back(bend * bend * bend * bend);
  }
  return result;
}

/// `to`, but no farther than `most` from `from`.
Vec3 no_farther(const Vec3& from, const Vec3& to, double most) {
  const double way = distance(from, to);
  return way <= most ? to : from + (to - from) * (most / way);
}

}  // namespace

void bring_inside(BranchLine& line, const SurfaceProbe& probe) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    Vec3& p = line.points[i].position;
    if (line.is_fixed(i) || !probe.is_outside(p)) continue;
    if (const auto inside = probe.inside_near(p)) p = *inside;
  }
}

void recentre(BranchLine& line, const SurfaceProbe& probe) {
  std::vector<Vec3> start;
  std::vector<double> leash;
  for (LinePoint& p : line.points) {
    start.push_back(p.position);
    leash.push_back(probe.hull(p.position));
    p.radius = probe.radius(p.position);
  }
  for (int round = 0; round < kRounds; ++round) {
    const auto places =
        relax(line, targets_of(line, probe), stiffness_of(line, probe.diagonal()));
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line.is_fixed(i)) continue;
      LinePoint& p = line.points[i];
      const Vec3 step = no_farther(p.position, places[i], kMostStep * p.radius);
      const LinePoint before = p;
      p.position = no_farther(start[i], step, leash[i]);
      p.radius = probe.radius(p.position, before.radius + distance(p.position, before.position) + 1e-9);
    }
  }
}

void mend_edges(BranchLine&, const SurfaceProbe&) {}

void measure_sections(BranchLine& line, const SurfaceProbe& probe) {
  constexpr double kMost = 1.5;  // radii
  for (std::size_t i = 0; i < line.size(); ++i) {
    LinePoint& p = line.points[i];
    p.section_radius = p.radius;
    const Vec3 tangent = tangent_at(line, i, tangent_reach(line, i, probe));
    if (line.is_fixed(i) || tangent == Vec3{}) continue;
    const Section section = probe.section(p.position, tangent, p.radius);
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
  if (line.is_fixed(0)) fade(0, [](std::size_t i) { return i + 1; });
  if (line.is_fixed(line.size() - 1)) fade(line.size() - 1, [](std::size_t i) { return i - 1; });
}

}  // namespace marrow
