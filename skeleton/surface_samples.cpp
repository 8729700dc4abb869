#include <algorithm>
#include <cmath>

#include "surface_samples_detail.hpp"

namespace marrow {

namespace {

// A sequence that fills the unit square evenly: powers of the plastic number.
constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;

Vec3 point(const NormalizedShape& shape, std::size_t i) {
  return {double{shape.x[i]}, double{shape.y[i]}, double{shape.z[i]}};
}

std::vector<double> areas_up_to(const NormalizedShape& shape) {
  std::vector<double> sums;
  sums.reserve(shape.triangles.size());
  double sum = 0;
  for (const Triangle& t : shape.triangles) {
    const Vec3 a = point(shape, t[0]);
    sum += 0.5 * length(cross(point(shape, t[1]) - a, point(shape, t[2]) - a));
    sums.push_back(sum);
  }
  return sums;
}

Vec3 point_in(const NormalizedShape& shape, const Triangle& t, double k) {
  double u = 0.5 + k * kFirst, v = 0.5 + k * kSecond;
  u -= std::floor(u);
  v -= std::floor(v);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Vec3 a = point(shape, t[0]);
  return a + (point(shape, t[1]) - a) * u + (point(shape, t[2]) - a) * v;
}

}  // namespace

std::vector<Vec3> surface_samples(const NormalizedShape& shape, std::size_t count) {
  std::vector<Vec3> samples;
  if (shape.is_point_cloud()) {
    count = std::min(count, shape.x.size());
    for (std::size_t k = 0; k < count; ++k)
      samples.push_back(point(shape, k * shape.x.size() / count));
    return samples;
  }
  const std::vector<double> areas = areas_up_to(shape);
  if (!(areas.back() > 0)) return samples;
  std::size_t triangle = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto at = static_cast<double>(k);
    const double area = (at + 0.5) / static_cast<double>(count) * areas.back();
    while (triangle + 1 < areas.size() && areas[triangle] < area) ++triangle;
    samples.push_back(point_in(shape, shape.triangles[triangle], at));
  }
  return samples;
}

}  // namespace marrow
