#include <marrow/error.hpp>
#include <marrow/normalization.hpp>
#include <marrow/point_spacing.hpp>
#include <marrow/quality.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/surface_scene.hpp>
#include <marrow/volume_summary.hpp>
#include <marrow/volume_surface.hpp>

#include <algorithm>
#include <cmath>

#include "ball_union_detail.hpp"
#include "centredness_detail.hpp"
#include "enclosure_detail.hpp"
#include "percentile_detail.hpp"
#include "surface_samples_detail.hpp"

namespace marrow {

namespace {

constexpr double kStep = 0.0025;       // of samples along the lines: of the diagonal
constexpr double kCovered = 0.01;      // outside the balls: of the diagonal
constexpr double kLongest = 8;         // of a distance: more than any between shape and skeleton
constexpr int kSections = 400;         // across the lines
constexpr double kMostSteps = 20'000;  // along them, however long they are
constexpr double kFarthest = 1e6;      // of a node, in radii of the shape
constexpr std::size_t kSurfaceSamples = 20'000;

void require_no_fault(const CurveSkeleton& skeleton) {
  if (const auto fault = fault_of(skeleton)) throw Error(ErrorKind::Malformed, *fault);
  if (skeleton.nodes.empty()) throw Error(ErrorKind::Malformed, "the skeleton has no nodes");
}

/// The skeleton in the frame of the shape.
CurveSkeleton to_frame_of(const Normalization& frame, CurveSkeleton skeleton) {
  const double scale = frame.prescale / frame.radius;
  for (auto& n : skeleton.nodes) {
    n.position = frame.to_normalized(n.position);
    if (!(length(n.position) < kFarthest))
      throw Error(
          ErrorKind::Malformed,
          "a node lies a million times the size of the shape away from it; give both in the "
          "same units");
    n.radius *= scale;
    n.section_radius *= scale;
  }
  return skeleton;
}

/// A node whose radius is not that of any ball inside has none.
struct NodeBall {
  double radius = 0;
  bool inside = false;
};

double reach_from(const Vec3& p) { return length(p) + kLongest; }

double distance_to(const SurfaceScene& surface, const Vec3& p, double reach) {
  const auto nearest = surface.nearest(p, reach);
  return nearest ? nearest->distance : reach;
}

std::vector<NodeBall> inscribed_balls(const SurfaceScene& surface, const CurveSkeleton& skeleton) {
  std::vector<NodeBall> balls;
  for (const auto& n : skeleton.nodes) {
    const bool inside = encloses(surface, n.position);
    balls.push_back(
        {inside ? distance_to(surface, n.position, reach_from(n.position)) : 0, inside});
  }
  return balls;
}

/// How much of the lines is outside, and how far from the surface they get there.
struct Excursions {
  double length = 0, outside = 0, most = 0;
};

Excursions excursions(const SurfaceScene& surface, const CurveSkeleton& skeleton, double diagonal) {
  const double step = std::max(kStep * diagonal, total_length(skeleton) / kMostSteps);
  Excursions result;
  for (const auto& [a, b] : skeleton.edges) {
    const Vec3 from = skeleton.nodes[a].position, way = skeleton.nodes[b].position - from;
    const double length = marrow::length(way);
    const double pieces = std::max(std::ceil(length / step), 1.0);
    for (double i = 0; i < pieces; ++i) {
      const Vec3 p = from + way * ((i + 0.5) / pieces);
      result.length += length / pieces;
      if (encloses(surface, p)) continue;
      result.outside += length / pieces;
      result.most = std::max(result.most, distance_to(surface, p, reach_from(p)));
    }
  }
  return result;
}

std::optional<Reconstruction> reconstruction(const std::vector<Vec3>& samples,
                                             const CurveSkeleton& skeleton,
                                             const std::vector<double>& radii, double diagonal) {
  if (samples.empty()) return {};
  const BallUnion balls(skeleton, radii);
  std::vector<double> away;
  std::size_t covered = 0;
  for (const Vec3& p : samples) {
    const double d = balls.distance(p) / diagonal;
    covered += d <= kCovered;
    away.push_back(std::abs(d));
  }
  return Reconstruction{mean_of(away), percentile(away, 0.95),
                        *std::max_element(away.begin(), away.end()),
                        static_cast<double>(covered) / static_cast<double>(samples.size())};
}

std::vector<double> own_radii(const CurveSkeleton& skeleton) {
  std::vector<double> radii;
  for (const auto& n : skeleton.nodes)
    radii.push_back(n.section_radius > 0 ? n.section_radius : n.radius);
  return radii;
}

/// What is measured against the surface of a mesh or a volume.
void measure_inside(SkeletonQuality& quality, const NormalizedShape& shape,
                    const std::vector<Vec3>& samples, const CurveSkeleton& skeleton,
                    double diagonal) {
  const SurfaceScene surface(shape);
  const std::vector<NodeBall> balls = inscribed_balls(surface, skeleton);
  const Excursions run = excursions(surface, skeleton, diagonal);
  const bool any_inside =
      run.length > 0 ? run.outside < run.length
                     : std::any_of(balls.begin(), balls.end(), [](auto& b) { return b.inside; });
  if (!shape.closed && !any_inside) return;
  if (run.length > 0) {
    quality.outside = run.outside / run.length;
    quality.outside_most = run.most / diagonal;
    quality.centredness = centredness(surface, skeleton, diagonal, kSections);
  }
  std::vector<double> radii, errors;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    radii.push_back(balls[i].radius);
    if (balls[i].inside) errors.push_back(std::abs(skeleton.nodes[i].radius - radii[i]) / diagonal);
  }
  quality.inscribed_reconstruction = reconstruction(samples, skeleton, radii, diagonal);
  if (!errors.empty()) quality.radius_error = mean_of(errors);
}

SkeletonQuality measure(const Normalization& frame, const NormalizedShape& shape,
                        double input_diagonal, const CurveSkeleton& input) {
  const CurveSkeleton skeleton = to_frame_of(frame, input);
  const double diagonal = input_diagonal / frame.length_to_input(1);
  const std::vector<Vec3> samples = surface_samples(shape, kSurfaceSamples);
  SkeletonQuality quality;
  quality.length = total_length(skeleton) / diagonal;
  quality.reconstruction = reconstruction(samples, skeleton, own_radii(skeleton), diagonal);
  if (!shape.is_point_cloud()) measure_inside(quality, shape, samples, skeleton, diagonal);
  return quality;
}

}  // namespace

std::optional<std::string> fault_of(const CurveSkeleton& skeleton) {
  const auto is_finite = [](const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    const auto& n = skeleton.nodes[i];
    const std::string node = "node " + std::to_string(i);
    if (!is_finite(n.position)) return node + " is not at a finite place";
    if (!(n.radius > 0) || !std::isfinite(n.radius)) return node + " has no radius";
    if (!(n.section_radius >= 0) || !std::isfinite(n.section_radius))
      return node + " has a section radius that is no number from 0 up";
  }
  for (std::size_t i = 0; i < skeleton.edges.size(); ++i) {
    const auto& e = skeleton.edges[i];
    const std::string edge = "edge " + std::to_string(i);
    if (std::max(e[0], e[1]) >= skeleton.nodes.size()) return edge + " has an end that is no node";
    if (e[0] >= e[1]) return edge + " is not from a lower to a higher node";
    if (i > 0 && !(skeleton.edges[i - 1] < e)) return edge + " is given twice, or out of order";
  }
  return {};
}

SkeletonQuality measure_quality(const Shape& shape, const CurveSkeleton& skeleton) {
  require_no_fault(skeleton);
  const std::vector<double> spacing = point_spacing(shape);
  const Normalization frame = normalize(shape, spacing);
  const ShapeSummary summary = summarize(shape);
  SkeletonQuality quality =
      measure(frame, apply(frame, shape, spacing), summary.bounds.diagonal(), skeleton);
  if (summary.is_closed()) quality.shape_components = static_cast<int>(summary.components);
  if (summary.handles) quality.shape_cycles = static_cast<int>(*summary.handles);
  return quality;
}

SkeletonQuality measure_quality(const Volume& volume, const CurveSkeleton& skeleton) {
  require_no_fault(skeleton);
  const Normalization frame = normalize(volume);
  SkeletonQuality quality = measure(frame, apply(frame, boundary_surface(volume)),
                                    foreground_bounds(volume).diagonal(), skeleton);
  if (const auto topology = topology_of(volume)) {
    quality.shape_components = static_cast<int>(topology->components);
    quality.shape_cycles = static_cast<int>(topology->tunnels);
  }
  return quality;
}

}  // namespace marrow
