#include <utility>
#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr int kMostHalvings = 4;

/// The middle of two points, pulled to where the shape is.
LinePoint middle(const LinePoint& a, const LinePoint& b, const SurfaceProbe& probe) {
  Vec3 p = (a.position + b.position) * 0.5;
  if (probe.is_outside(p)) p = probe.inside_near(p).value_or(p);
  const Vec3 chord = b.position - a.position;
  const Vec3 centre = probe.section(p, chord / length(chord), probe.radius(p)).centre;
  if (!probe.is_blocked(p, centre)) p = centre;
  return measured(p, probe);
}

/// Adds what the edge from the last point of `points` to `next` needs, and `next`.
void extend(std::vector<LinePoint>& points, const LinePoint& next, int halvings,
            const SurfaceProbe& probe) {
  const LinePoint last = points.back();
  const double edge = distance(last.position, next.position);
  const bool is_certain = edge <= last.radius + next.radius;  // two empty balls hold it
  if (halvings > 0 && !is_certain && probe.is_blocked(last.position, next.position)) {
    extend(points, middle(last, next, probe), halvings - 1, probe);
    extend(points, next, halvings - 1, probe);
    return;
  }
  points.push_back(next);
}

}  // namespace

void mend_edges(BranchLine& line, const SurfaceProbe& probe) {
  std::vector<LinePoint> points{line.points.front()};
  for (std::size_t e = 0; e < line.edge_count(); ++e)
    extend(points, line.points[line.after(e)], kMostHalvings, probe);
  if (line.is_ring) points.pop_back();
  line.points = std::move(points);
}

}  // namespace marrow
