#include <marrow/error.hpp>
#include <marrow/shape_check.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace marrow {

namespace {

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check_point(const Shape& shape, std::uint32_t i) {
  if (i >= shape.points.size())
    throw Error(ErrorKind::Malformed, "point index " + std::to_string(i) + " is not below " +
                                          std::to_string(shape.points.size()) +
                                          "; give triangles between the points of the shape");
  if (!is_finite(shape.points[i]))
    throw Error(ErrorKind::Malformed,
                "point " + std::to_string(i) + " is not finite; give a number for each coordinate");
}

}  // namespace

void check_shape(const Shape& shape) {
  std::uint32_t greatest = 0;
  for (const Triangle& t : shape.triangles) greatest = std::max({greatest, t[0], t[1], t[2]});
  const bool good = (shape.is_point_cloud() || greatest < shape.points.size()) &&
                    std::all_of(shape.points.begin(), shape.points.end(), is_finite);
  if (good) return;  // in a pass over either, without a look from one into the other
  for (const Triangle& t : shape.triangles)
    for (const std::uint32_t i : t) check_point(shape, i);
  if (shape.is_point_cloud())
    for (std::uint32_t i = 0; i < shape.points.size(); ++i) check_point(shape, i);
}

}  // namespace marrow
