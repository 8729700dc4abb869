#include <marrow/bounds.hpp>
#include <marrow/error.hpp>
#include <marrow/normalization.hpp>
#include <marrow/point_spacing.hpp>
#include <marrow/prescale.hpp>
#include <marrow/shape_check.hpp>

#include <algorithm>
#include <cmath>

#include "closure_detail.hpp"
#include "lattice_surface_detail.hpp"
#include "principal_frame_detail.hpp"
#include "used_points_detail.hpp"

namespace marrow {

namespace {

/// The triangles between the used points, numbered anew.
std::vector<Triangle> renumbered(const Shape& shape, const std::vector<std::uint8_t>& used) {
  if (std::find(used.begin(), used.end(), 0) == used.end()) return shape.triangles;
  std::vector<std::uint32_t> number(used.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) number[i] = next++;
  std::vector<Triangle> triangles;
  triangles.reserve(shape.triangles.size());
  for (const auto& t : shape.triangles)
    triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return triangles;
}

/// The frame of a shape, which must have triangles.
Normalization normalize_triangles(const Shape& shape) {
  check_shape(shape);
  const auto used = used_points(shape);
  Bounds box;
  for_used_points(shape, used, [&](const Vec3& p) { box.add(p); });
  Normalization n;
  n.prescale = prescale_of(box);
  box.low = box.low * n.prescale;
  box.high = box.high * n.prescale;
  // A box thinner than the rounding of its own coordinates holds no shape.
  const double magnitude = std::max(length(box.low), length(box.high));
  if (!(box.longest_side() > 1e-12 * magnitude))
    throw Error(ErrorKind::Empty,
                "all points of the shape coincide; give a shape with some extent");

  const LatticeSurface surface(shape, n.prescale, box.center(), box.longest_side());
  const Covariance c = surface.moments().covariance();
  n.axes = principal_frame(c.matrix, [&](const std::array<Vec3, 2>& axes) {
    return surface.third_moments(c.mean, axes);
  });
  Bounds own;
  for_used_points(shape, used,
                  [&](const Vec3& p) { own.add(to_frame(n.axes, p * n.prescale - box.center())); });
  n.center = box.center() + from_frame(n.axes, own.center());
  double squared_radius = 0;
  for_used_points(shape, used, [&](const Vec3& p) {
    squared_radius = std::max(squared_radius, squared_length(p * n.prescale - n.center));
  });
  n.radius = std::sqrt(squared_radius);
  return n;
}

}  // namespace

Normalization normalize(const Shape& shape, std::span<const double> spacing) {
  if (shape.points.empty())
    throw Error(ErrorKind::Empty, "the shape has no points; give a mesh or a point cloud");
  if (!shape.is_point_cloud()) return normalize_triangles(shape);
  Normalization n = normalize_triangles(with_point_triangles(shape, spacing));
  for (std::size_t i = 0; i < spacing.size(); ++i)
    if (spacing[i] > 0)
      n.radius = std::max(
          n.radius, length(shape.points[i] * n.prescale - n.center) + spacing[i] * n.prescale);
  return n;
}

Normalization normalize(const Shape& shape) { return normalize(shape, point_spacing(shape)); }

NormalizedShape apply(const Normalization& normalization, const Shape& shape,
                      std::span<const double> spacing) {
  const bool is_cloud = shape.is_point_cloud();
  const auto used = is_cloud ? used_points(spacing) : used_points(shape);
  NormalizedShape result;
  const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  for (auto* axis : {&result.x, &result.y, &result.z}) axis->resize(count);
  Bounds box;
  std::size_t next = 0;
  for_used_points(shape, used, [&](const Vec3& p) {
    const Vec3 q = normalization.to_normalized(p);
    box.add(q);
    result.x[next] = static_cast<float>(q.x);
    result.y[next] = static_cast<float>(q.y);
    result.z[next] = static_cast<float>(q.z);
    ++next;
  });
  result.low = box.low;
  result.high = box.high;
  if (is_cloud) {
    const double scale = normalization.prescale / normalization.radius;
    for (const double d : spacing)
      if (d > 0) result.spacing.push_back(static_cast<float>(d * scale));
    return result;
  }
  result.triangles = renumbered(shape, used);
  const Closure closure = closure_of(shape);
  result.closed = closure.closed;
  result.oriented = closure.oriented;
  return result;
}

double median_spacing(const NormalizedShape& cloud) {
  std::vector<float> spacing = cloud.spacing;
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  return static_cast<double>(*middle);
}

NormalizedShape apply(const Normalization& normalization, const Shape& shape) {
  return apply(normalization, shape, point_spacing(shape));
}

}  // namespace marrow
