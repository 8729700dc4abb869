// What a point in the shape asks the surface around it.
#pragma once

#include <marrow/refinement.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "branch_lines_detail.hpp"
#include "symmetric3_detail.hpp"

namespace marrow {

/// Opposite walls that a point sees in the plane across a line.
struct Walls {
  struct Pair {
    Vec3 direction;
    double ahead, back;
  };
  std::array<Pair, 4> pairs;
  std::size_t count = 0;  ///< of the pairs: those with two walls
  double nearest = 0;     ///< way to the nearest of them; 0: none
};

/// What these walls say of the middle.
struct Section {
  Symmetric3 weight;      ///< how firmly each direction is told: flat sections say little of their
                          ///< long side
  Vec3 centre;            ///< where opposite walls are as far
  double half_width = 0;  ///< median over the directions; 0: too few walls
};

/// A free way from a point to the surface.
struct Way {
  Vec3 direction;
  double length = 0;
};

/// The longest of them but for those within 37 degrees of the unit vector `apart_from`; none has no
/// length.
Way longest(std::span<const Way> ways, const Vec3& apart_from = {});

class SurfaceProbe {
 public:
  static constexpr double kFar = 4;  ///< beyond everything: the shape lies in the unit ball

  /// `samples` are points in the shape, which tell whether walls stand inside it.
  SurfaceProbe(const RefinementInput& input, std::span<const Vec3> samples);

  double diagonal() const { return diagonal_; }
  double pixel() const { return input_.pixel; }

  /// Radius of the ball that the silhouettes allow, half a pixel at least.
  double hull(const Vec3& p) const;
  /// Distance to the surface; the sooner found the less it is known to be at most.
  double radius(const Vec3& p, double most = kFar) const;
  /// Walls that have been `seen` from a place nearby are taken to go on a little as they are there;
  /// the others become what is seen now.
  Walls walls_across(const Vec3& p, const Vec3& tangent, SeenWalls& seen) const;
  /// At a point whose distance to the surface is `radius`.
  Section section(const Vec3& p, const Vec3& tangent, const Walls& walls, double radius) const;
  Section section(const Vec3& p, const Vec3& tangent, double radius) const {
    SeenWalls seen;
    return section(p, tangent, walls_across(p, tangent, seen), radius);
  }
  /// Way to the first wall in a direction; kFar without one.
  double free_way(const Vec3& p, const Vec3& direction) const;
  /// Up to 162 ways, all around but for those back into a limb that points along `limb`.
  std::vector<Way> free_ways(const Vec3& p, const Vec3& limb) const;
  /// Way to the wall straight ahead: the median of a cone of rays.
  double ahead(const Vec3& p, const Vec3& direction) const;
  bool is_outside(const Vec3& p) const;
  /// The middle between the nearest wall and the one behind it, if they are close.
  std::optional<Vec3> inside_near(const Vec3& p) const;
  /// Whether a wall stands between two points.
  bool is_blocked(const Vec3& a, const Vec3& b) const;

 private:
  std::optional<SurfaceHit> nearest_wall(const Vec3& p, double reach) const;
  std::optional<SurfaceHit> wall(const Vec3& from, const Vec3& direction) const;
  /// The same as free_way(), unless a wall that was seen goes on; else `seen` becomes what is met.
  double way_to_wall(const Vec3& from, const Vec3& direction,
                     std::optional<SurfaceHit>& seen) const;
  std::optional<double> way_on(const Vec3& from, const Vec3& direction,
                               const std::optional<SurfaceHit>& seen) const;
  bool is_inner(const Vec3& from, const SurfaceHit& hit) const;

  RefinementInput input_;
  double diagonal_;
  bool has_inner_walls_ = false;
};

}  // namespace marrow
