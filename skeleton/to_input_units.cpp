#include <marrow/extract.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace marrow {

namespace {

constexpr double kDigits = 1e-6;  // of the diagonal: what is finer is noise

/// A power of ten by multiplication: exact up to 10^22, the same everywhere beyond.
double power_of_ten(int exponent) {
  double p = 1;
  for (int i = 0; i < std::abs(exponent); ++i) p *= 10;
  return exponent < 0 ? 1 / p : p;
}

/// Rounds to a decimal place, so that the shortest text of a number is short.
class DecimalRounding {
 public:
  explicit DecimalRounding(double quantum) {
    // Powers of ten end, and so do the digits of numbers that small; no rounding then.
    exact_ = !(quantum > 1e-290 && quantum < 1e290);
    if (exact_) return;
    int exponent = 0;
    double p = 1;
    while (p > quantum && exponent > -300) p = power_of_ten(--exponent);
    while (p * 10 <= quantum && exponent < 300) p = power_of_ten(++exponent);
    power_ = power_of_ten(std::abs(exponent));
    fraction_ = exponent < 0;
  }

  double operator()(double v) const {
    if (exact_) return v + 0.0;  // no negative zero
    const double rounded =
        fraction_ ? std::nearbyint(v * power_) / power_ : std::nearbyint(v / power_) * power_;
    return std::isfinite(rounded) ? rounded + 0.0 : v;  // + 0.0: no negative zero
  }

 private:
  double power_ = 1;
  bool fraction_ = false, exact_ = false;
};

}  // namespace

CurveSkeleton skeleton_of(const VoteGraph& graph) {
  CurveSkeleton skeleton;
  skeleton.nodes.reserve(graph.nodes.size());
  for (const auto& n : graph.nodes) skeleton.nodes.push_back({n.position, n.radius});
  skeleton.edges = graph.edges;
  return skeleton;
}

CurveSkeleton to_input_units(const VoteGraph& graph, const Normalization& normalization) {
  return to_input_units(skeleton_of(graph), normalization);
}

CurveSkeleton to_input_units(const CurveSkeleton& skeleton, const Normalization& normalization) {
  const double diagonal = normalization.length_to_input(2);
  const DecimalRounding round(kDigits * diagonal);
  // Of a shape at the end of the range of numbers this would be zero or infinite.
  const double least_radius =
      std::clamp(kDigits * diagonal, std::numeric_limits<double>::denorm_min(), 1e300);
  CurveSkeleton result = skeleton;
  for (auto& n : result.nodes) {
    const Vec3 p = normalization.to_input(n.position);
    n.position = {round(p.x), round(p.y), round(p.z)};
    n.radius = std::max(round(normalization.length_to_input(n.radius)), least_radius);
    if (n.section_radius > 0)
      n.section_radius = std::max(round(normalization.length_to_input(n.section_radius)), n.radius);
  }
  return result;
}

}  // namespace marrow
