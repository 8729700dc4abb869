// The hull of two balls, which is the union of all balls between them.
#pragma once

#include "curve.hpp"
#include "field.hpp"

namespace marrow {

/// A round cone, thinner by `flatness` along `flat_axis`.
class RoundCone {
 public:
  RoundCone(const Ball& a, const Ball& b, double flatness, const Vec3& flat_axis);

  /// Distance from the surface, exact where the cone is not flat; else it has the right zero and
  /// the right slope there.
  double value(const Vec3& p) const;
  FieldSample sample(const Vec3& p) const;
  FieldRange range(const Vec3& centre, double radius) const;

  /// Radius of a ball around `p` that lies inside, the largest one (of a flat cone, nearly
  /// so) for `p` on the axis; not positive outside.
  double inner_radius(const Vec3& p) const;

 private:
  /// One end, the way to the other, and what is needed to find the ball whose surface is nearest.
  struct Spine {
    Vec3 start, axis;
    double length = 0, start_radius = 0, end_radius = 0;
    double tangent = 0;  ///< of half the angle of the cone

    Spine() = default;
    Spine(const Ball& a, const Ball& b);
  };
  struct Contact {
    double distance;
    Vec3 towards;  ///< from the centre of the ball that is nearest
    double reach;  ///< length of `towards`
  };

  static Contact contact(const Spine& spine, const Vec3& p);
  Vec3 stretched(const Vec3& v) const { return v + flat_axis_ * (dot(v, flat_axis_) * extra_); }
  FieldSample flat_sample(const Vec3& p) const;

  Spine round_;
  Spine stretched_;  ///< of a flat cone: pulled along the flat axis until it is round
  Vec3 flat_axis_;
  double extra_;  ///< flatness - 1
};

}  // namespace marrow
