// The union of the balls of a skeleton, as a body.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <array>
#include <span>
#include <vector>

namespace marrow {

/// The hulls of the two balls at every edge, and the balls of nodes without an edge.
class BallUnion {
 public:
  /// `radii` has one for every node.
  BallUnion(const CurveSkeleton& skeleton, std::span<const double> radii);

  /// Signed distance of `p` from the nearest of these hulls, negative inside.
  double distance(const Vec3& p) const;

 private:
  /// The hull of two balls: a round cone.
  struct Cone {
    Vec3 start, axis;  // a unit vector
    double length = 0;
    double start_radius = 0, end_radius = 0;
    double slope = 0;  // where the foot on the axis lies behind the one straight below, per height

    Cone(const Vec3& a, const Vec3& b, double radius_a, double radius_b);
    double distance(const Vec3& p) const;
  };
  /// Cones that stand together in a ball.
  struct Group {
    Vec3 centre;
    double radius = 0;
    std::size_t begin = 0, end = 0;
  };

  void add_groups();

  std::vector<Cone> cones_;
  std::vector<Group> groups_;
};

}  // namespace marrow
