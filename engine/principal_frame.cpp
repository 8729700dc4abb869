#include <algorithm>
#include <cmath>

#include "principal_frame_detail.hpp"

namespace marrow {

namespace {

constexpr double kSameMoment = 1e-5;  // relative gap under which two moments coincide
constexpr double kNoSkew = 1e-4;      // third moment, relative, under which it vanishes

/// The input axis that `subspace` (an orthogonal complement given by its normal, or all of space
/// for a zero normal) holds best, projected into it.
Vec3 best_input_axis(const Vec3& normal) {
  Vec3 best;
  double longest = -1;
  for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 inside = e - normal * dot(normal, e);
    if (squared_length(inside) > longest + 1e-9) longest = squared_length(inside), best = inside;
  }
  return normalized(best);
}

/// Directions of greatest, middle and least spread, before signs; ties by the input axes.
std::array<Vec3, 3> principal_axes(const Eigensystem& e) {
  const double gap = kSameMoment * std::max(e.values[0], 1e-300);
  const bool first_tie = e.values[0] - e.values[1] <= gap;
  const bool second_tie = e.values[1] - e.values[2] <= gap;
  if (first_tie && second_tie) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  if (first_tie) {
    const Vec3 a = best_input_axis(e.vectors[2]);
    return {a, cross(e.vectors[2], a), e.vectors[2]};
  }
  if (second_tie) {
    const Vec3 b = best_input_axis(e.vectors[0]);
    return {e.vectors[0], b, cross(e.vectors[0], b)};
  }
  return e.vectors;
}

Vec3 with_greatest_component_positive(const Vec3& v) {
  // Two components may be equal up to rounding: a later one must be clearly greater.
  double greatest = v.x;
  for (const double c : {v.y, v.z})
    if (std::abs(c) > std::abs(greatest) + 1e-6) greatest = c;
  return greatest < 0 ? -v : v;
}

}  // namespace

Frame principal_frame(const SymmetricMatrix& covariance, const ThirdMoments& third_moments) {
  const Eigensystem e = eigensystem(covariance);
  auto axes = principal_axes(e);
  const auto third = third_moments({axes[0], axes[1]});
  for (std::size_t i = 0; i < 2; ++i) {
    const double variance = std::max(e.values[i], 1e-300);
    const double skew = third[i] / (variance * std::sqrt(variance));
    if (std::abs(skew) > kNoSkew)
      axes[i] = skew < 0 ? -axes[i] : axes[i];
    else
      axes[i] = with_greatest_component_positive(axes[i]);
  }
  const Vec3 y = axes[0], x = axes[1];
  return {x, y, cross(x, y)};
}

}  // namespace marrow
