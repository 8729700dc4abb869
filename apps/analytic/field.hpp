// Distance fields: negative inside, zero on the surface.
#pragma once

#include <marrow/vec.hpp>

#include <functional>
#include <memory>

namespace marrow {

/// Values between which a field stays inside a ball.
struct FieldRange {
  double low = 0, high = 0;
};

struct FieldSample {
  double value = 0;
  Vec3 slope;  ///< gradient; near the surface its error vanishes with the value
};

/// A field is not asked to be an exact distance, only to have a gradient near one at its surface.
class Field {
 public:
  virtual ~Field() = default;
  Field() = default;
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  virtual double value(const Vec3& p) const = 0;
  virtual FieldSample sample(const Vec3& p) const = 0;

  /// Bounds of the values in the ball; they may be wider than need be.
  virtual FieldRange range(const Vec3& centre, double radius) const = 0;

  /// A field with exactly the same values in the ball that leaves out what is too far to matter.
  virtual std::shared_ptr<const Field> near(const Vec3& centre, double radius) const = 0;
};

/// A field from a function that changes by no more than the way one walks.
std::shared_ptr<const Field> make_field(std::function<double(const Vec3&)> distance);

/// min(a, b), rounded over within `k`: equal to it where they differ by k or more, lower elsewhere,
/// by k/4 at most.
double smooth_min(double a, double b, double k);

/// max(a, b), rounded over in the same way.
double smooth_max(double a, double b, double k);

/// The same with gradients.
FieldSample smooth_min(const FieldSample& a, const FieldSample& b, double k);

}  // namespace marrow
