#include <algorithm>
#include <cmath>
#include <limits>

#include "ball_union_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kGroup = 12;  // cones

}  // namespace

BallUnion::Cone::Cone(const Vec3& a, const Vec3& b, double radius_a, double radius_b)
    : start(a), axis(b - a), start_radius(radius_a), end_radius(radius_b) {
  length = marrow::length(axis);
  const double shrink = start_radius - end_radius;
  if (!(length > std::abs(shrink))) {  // one ball holds the other
    if (start_radius < end_radius) start = b, start_radius = end_radius;
    end_radius = start_radius;
    length = 0;
    axis = {};
    return;
  }
  axis = axis / length;
  slope = shrink / std::sqrt(length * length - shrink * shrink);
}

/// The nearest ball is the one whose surface the shortest way to the cone runs out of.
double BallUnion::Cone::distance(const Vec3& p) const {
  const Vec3 q = p - start;
  if (length == 0) return marrow::length(q) - start_radius;
  const double along = dot(q, axis);
  const double height = std::sqrt(std::max(squared_length(q) - along * along, 0.0));
  const double foot = std::clamp(along - height * slope, 0.0, length);
  const double away = along - foot;
  return std::sqrt(away * away + height * height) - start_radius -
         (end_radius - start_radius) * (foot / length);
}

BallUnion::BallUnion(const CurveSkeleton& skeleton, std::span<const double> radii) {
  const std::vector<int> degree = degrees(skeleton);
  const auto at = [&](NodeId n) { return skeleton.nodes[n].position; };
  // Along the branches neighbours stand together.
  for (const Branch& branch : branches(skeleton))
    for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
      const NodeId a = branch.nodes[i - 1], b = branch.nodes[i];
      cones_.emplace_back(at(a), at(b), radii[a], radii[b]);
    }
  for (NodeId n = 0; n < skeleton.nodes.size(); ++n)
    if (degree[n] == 0) cones_.emplace_back(at(n), at(n), radii[n], radii[n]);
  add_groups();
}

void BallUnion::add_groups() {
  for (std::size_t begin = 0; begin < cones_.size(); begin += kGroup) {
    Group group{{}, 0, begin, std::min(begin + kGroup, cones_.size())};
    const auto middle = [](const Cone& c) { return c.start + c.axis * (0.5 * c.length); };
    for (std::size_t i = begin; i < group.end; ++i) group.centre += middle(cones_[i]);
    group.centre = group.centre / static_cast<double>(group.end - begin);
    for (std::size_t i = begin; i < group.end; ++i) {
      const Cone& c = cones_[i];
      const double reach = marrow::distance(middle(c), group.centre) + 0.5 * c.length +
                           std::max(c.start_radius, c.end_radius);
      group.radius = std::max(group.radius, reach);
    }
    groups_.push_back(group);
  }
}

double BallUnion::distance(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Group& group : groups_) {
    if (marrow::distance(p, group.centre) - group.radius >= least) continue;
    for (std::size_t i = group.begin; i < group.end; ++i)
      least = std::min(least, cones_[i].distance(p));
  }
  return least;
}

}  // namespace marrow
