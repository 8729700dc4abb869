#include "field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marrow {
namespace {

class FunctionField : public Field {
 public:
  explicit FunctionField(std::function<double(const Vec3&)> distance)
      : distance_(std::move(distance)) {}

  double value(const Vec3& p) const override { return distance_(p); }

  FieldSample sample(const Vec3& p) const override {
    constexpr double kStep = 1e-5;
    const auto slope = [&](const Vec3& d) {
      return (distance_(p + d) - distance_(p - d)) / (2 * kStep);
    };
    return {distance_(p), {slope({kStep, 0, 0}), slope({0, kStep, 0}), slope({0, 0, kStep})}};
  }

  FieldRange range(const Vec3& centre, double radius) const override {
    const double d = distance_(centre);
    return {d - radius, d + radius};
  }

  std::shared_ptr<const Field> near(const Vec3&, double) const override {
    return make_field(distance_);
  }

 private:
  std::function<double(const Vec3&)> distance_;
};

}  // namespace

std::shared_ptr<const Field> make_field(std::function<double(const Vec3&)> distance) {
  return std::make_shared<FunctionField>(std::move(distance));
}

double smooth_min(double a, double b, double k) {
  const double overlap = k - std::abs(a - b);
  return std::min(a, b) - (overlap > 0 ? overlap * overlap / (4 * k) : 0);
}

double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

FieldSample smooth_min(const FieldSample& a, const FieldSample& b, double k) {
  const FieldSample& low = a.value <= b.value ? a : b;
  const FieldSample& high = a.value <= b.value ? b : a;
  const double overlap = k - (high.value - low.value);
  if (!(overlap > 0)) return low;
  const double share = overlap / (2 * k);
  return {low.value - overlap * overlap / (4 * k), low.slope + (high.slope - low.slope) * share};
}

}  // namespace marrow
