#include "round_cone.hpp"

#include <algorithm>
#include <cmath>

namespace marrow {
namespace {

FieldSample sample_at(double distance, const Vec3& towards, double reach) {
  constexpr double kOnAxis = 1e-12;  // the slope has no direction there
  return {distance, reach < kOnAxis ? Vec3{} : towards / reach};
}

}  // namespace

RoundCone::Spine::Spine(const Ball& a, const Ball& b)
    : start(a.centre), start_radius(a.radius), end_radius(b.radius) {
  const Vec3 span = b.centre - a.centre;
  const double span_length = marrow::length(span);
  const double step = start_radius - end_radius;
  if (span_length <= std::abs(step)) {  // one ball holds the other
    if (step < 0) start = b.centre;
    start_radius = end_radius = std::max(start_radius, end_radius);
    return;
  }
  length = span_length;
  axis = span / span_length;
  const double sine = step / span_length;
  tangent = sine / std::sqrt(1 - sine * sine);
}

RoundCone::RoundCone(const Ball& a, const Ball& b, double flatness, const Vec3& flat_axis)
    : round_(a, b), flat_axis_(flat_axis), extra_(flatness - 1) {
  if (extra_ > 0) {
    stretched_ = Spine({stretched(a.centre), a.radius}, {stretched(b.centre), b.radius});
  }
}

RoundCone::Contact RoundCone::contact(const Spine& spine, const Vec3& p) {
  const Vec3 offset = p - spine.start;
  if (spine.length == 0) {
    const double reach = length(offset);
    return {reach - spine.start_radius, offset, reach};
  }
  const double along = dot(offset, spine.axis);
  const double aside = std::sqrt(std::max(0.0, squared_length(offset) - along * along));
  const double at = std::clamp(along - aside * spine.tangent, 0.0, spine.length);
  const Vec3 towards = offset - spine.axis * at;
  const double reach = length(towards);
  const double share = at / spine.length;
  const double radius = spine.start_radius + (spine.end_radius - spine.start_radius) * share;
  return {reach - radius, towards, reach};
}

double RoundCone::value(const Vec3& p) const {
  return extra_ == 0 ? contact(round_, p).distance : sample(p).value;
}

FieldSample RoundCone::sample(const Vec3& p) const {
  const Contact at = contact(round_, p);
  const FieldSample round = sample_at(at.distance, at.towards, at.reach);
  if (extra_ == 0) return round;
  // The flat cone lies in the round one: farther off, the round one tells the distance better.
  const FieldSample flat = flat_sample(p);
  return flat.value >= round.value ? flat : round;
}

/// The stretched distance over the length of its gradient.
FieldSample RoundCone::flat_sample(const Vec3& p) const {
  const Contact at = contact(stretched_, stretched(p));
  const Vec3 steepest = stretched(at.towards);
  const double size = length(steepest);
  const double shrink = at.reach < 1e-9 ? 1 / (1 + extra_) : at.reach / size;
  return sample_at(at.distance * shrink, steepest, size);
}

FieldRange RoundCone::range(const Vec3& centre, double radius) const {
  const double round = contact(round_, centre).distance;
  if (extra_ == 0) return {round - radius, round + radius};
  // The stretched distance changes by at most `factor` per length and is divided by 1 to `factor`.
  const double factor = 1 + extra_;
  const double flat = contact(stretched_, stretched(centre)).distance;
  const double low = flat - radius * factor;
  const double high = flat + radius * factor;
  // Nor is the value above the distance from the centre of the nearest ball less its thickness.
  const Vec3 end = round_.start + round_.axis * round_.length;
  const double reach = std::max(distance(centre, round_.start), distance(centre, end)) + radius -
                       std::min(round_.start_radius, round_.end_radius) / factor;
  return {std::max(low > 0 ? low / factor : low, round - radius),
          std::min(reach, high > 0 ? high : high / factor)};
}

double RoundCone::inner_radius(const Vec3& p) const {
  if (extra_ == 0) return -contact(round_, p).distance;
  // Half the thickness of the section at `p`, seen square to the side that tapers.
  const double factor = 1 + extra_;
  const double taper = stretched_.tangent * stretched_.tangent;
  const double lean = std::sqrt((1 + taper) / (1 + taper / (factor * factor)));
  return -contact(stretched_, stretched(p)).distance * lean / factor;
}

}  // namespace marrow
