#include "tube.hpp"

#include <algorithm>
#include <cmath>

#include "trig.hpp"

namespace marrow {
namespace {

struct Ring {
  Vec3 centre;
  double radius = 0;
  Vec3 u, v;
};

/// Direction of the curve and change of the radius per length at every ball.
struct Slopes {
  std::vector<Vec3> tangent;
  std::vector<double> taper;
};

Slopes slopes_of(const Curve& curve) {
  const auto& balls = curve.balls;
  const std::size_t n = balls.size();
  Slopes slopes;
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0 && !curve.is_closed;
    const bool last = i + 1 == n && !curve.is_closed;
    const Ball& a = balls[first ? i : (i + n - 1) % n];
    const Ball& b = balls[last ? i : (i + 1) % n];
    const double span = distance(a.centre, b.centre);
    slopes.tangent.push_back((b.centre - a.centre) / span);
    slopes.taper.push_back(std::clamp((b.radius - a.radius) / span, -0.99, 0.99));
  }
  return slopes;
}

/// Turns `normal` from direction `from` to `to` by the smallest rotation.
Vec3 transported(const Vec3& normal, const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const double c = dot(from, to);
  const Vec3 turned = normal * c + cross(axis, normal) + axis * (dot(axis, normal) / (1 + c));
  return normalized(turned - to * dot(to, turned));
}

Vec3 any_normal(const Vec3& tangent) {
  const Vec3 helper = std::abs(tangent.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized(helper - tangent * dot(tangent, helper));
}

/// Rotation-minimising normals; a closed curve spreads the angle that is left over evenly.
std::vector<Vec3> normals_of(const std::vector<Vec3>& tangent, bool is_closed) {
  std::vector<Vec3> normal{any_normal(tangent[0])};
  for (std::size_t i = 1; i < tangent.size(); ++i) {
    normal.push_back(transported(normal.back(), tangent[i - 1], tangent[i]));
  }
  if (!is_closed) return normal;
  const Vec3 back = transported(normal.back(), tangent.back(), tangent[0]);
  const double twist = turns_of(dot(back, cross(tangent[0], normal[0])), dot(back, normal[0]));
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(normal.size());
    const SinCos turn = sin_cos_of_turns(-twist * share);
    normal[i] = normal[i] * turn.cos + cross(tangent[i], normal[i]) * turn.sin;
  }
  return normal;
}

/// Rings of the cap from the pole to the ring where the tube takes over, without both.
void append_cap(std::vector<Ring>& rings, const Ball& ball, const Vec3& out, double sine_at_tube,
                const Ring& frame, int sides, bool to_pole) {
  const double cosine = std::sqrt(1 - sine_at_tube * sine_at_tube);
  const double start = turns_of(sine_at_tube, cosine);  // latitude, the pole is at 1/4
  const int steps = std::max(2, static_cast<int>(std::ceil((0.25 - start) * sides)));
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(to_pole ? i : steps - i) / steps;
    const SinCos at = sin_cos_of_turns(start + (0.25 - start) * share);
    rings.push_back(
        {ball.centre + out * (ball.radius * at.sin), ball.radius * at.cos, frame.u, frame.v});
  }
}

std::vector<Ring> rings_of(const Curve& curve, int sides) {
  const Slopes slopes = slopes_of(curve);
  const std::vector<Vec3> normal = normals_of(slopes.tangent, curve.is_closed);
  std::vector<Ring> tube;
  for (std::size_t i = 0; i < curve.balls.size(); ++i) {
    const Ball& ball = curve.balls[i];
    // The ball touches its envelope in a ring this far ahead of its middle.
    const double s = -slopes.taper[i];
    const Vec3& t = slopes.tangent[i];
    tube.push_back({ball.centre + t * (ball.radius * s), ball.radius * std::sqrt(1 - s * s),
                    normal[i], cross(t, normal[i])});
  }
  if (curve.is_closed) return tube;
  std::vector<Ring> rings;
  append_cap(rings, curve.balls.front(), -slopes.tangent.front(), slopes.taper.front(),
             tube.front(), sides, false);
  rings.insert(rings.end(), tube.begin(), tube.end());
  append_cap(rings, curve.balls.back(), slopes.tangent.back(), -slopes.taper.back(), tube.back(),
             sides, true);
  return rings;
}

void append_poles(Shape& shape, const Curve& curve, std::uint32_t sides) {
  const Slopes slopes = slopes_of(curve);
  const auto south = static_cast<std::uint32_t>(shape.points.size());
  const std::uint32_t last_ring = south - sides;
  const Ball& a = curve.balls.front();
  const Ball& b = curve.balls.back();
  shape.points.push_back(a.centre - slopes.tangent.front() * a.radius);
  shape.points.push_back(b.centre + slopes.tangent.back() * b.radius);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    shape.triangles.push_back({j, i, south});
    shape.triangles.push_back({last_ring + i, last_ring + j, south + 1});
  }
}

}  // namespace

Shape make_tube(const Curve& curve, int sides) {
  const std::vector<Ring> rings = rings_of(curve, sides);
  const auto around = static_cast<std::uint32_t>(sides);
  const auto count = static_cast<std::uint32_t>(rings.size());
  Shape shape;
  for (const Ring& ring : rings) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const SinCos at = sin_cos_of_turns(static_cast<double>(i) / sides);
      shape.points.push_back(ring.centre + (ring.u * at.cos + ring.v * at.sin) * ring.radius);
    }
  }
  for (std::uint32_t r = 0; r < (curve.is_closed ? count : count - 1); ++r) {
    const std::uint32_t here = r * around;
    const std::uint32_t next = (r + 1) % count * around;
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t j = (i + 1) % around;
      shape.triangles.push_back({here + i, here + j, next + j});
      shape.triangles.push_back({here + i, next + j, next + i});
    }
  }
  if (!curve.is_closed) append_poles(shape, curve, around);
  return shape;
}

void append(Shape& shape, const Shape& more) {
  const auto offset = static_cast<std::uint32_t>(shape.points.size());
  shape.points.insert(shape.points.end(), more.points.begin(), more.points.end());
  for (const Triangle& t : more.triangles) {
    shape.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
}

}  // namespace marrow
