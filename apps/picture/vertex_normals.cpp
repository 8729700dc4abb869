#include "picture/vertex_normals.hpp"

#include <tbb/parallel_sort.h>

#include <cmath>
#include <cstdint>
#include <numeric>

namespace marrow {
namespace {

float dot3(const Point3f& a, const Point3f& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// For every point the first point at the same place.
std::vector<std::uint32_t> weld(std::span<const Point3f> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

void add_agreeing(Point3f& sum, const Point3f& normal) {
  const float sign = dot3(sum, normal) < 0 ? -1.0F : 1.0F;
  for (std::size_t k = 0; k < 3; ++k) sum[k] += sign * normal[k];
}

void normalize(Point3f& v) {
  const float length = std::sqrt(dot3(v, v));
  if (!(length > 0)) return;
  for (float& part : v) part /= length;
}

}  // namespace

Point3f face_normal(std::span<const Point3f> points, const Triangle& triangle) {
  const Point3f& a = points[triangle[0]];
  const Point3f& b = points[triangle[1]];
  const Point3f& c = points[triangle[2]];
  const Point3f u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Point3f v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

std::vector<Point3f> vertex_normals(std::span<const Point3f> points,
                                    std::span<const Triangle> triangles) {
  const std::vector<std::uint32_t> first = weld(points);
  std::vector<Point3f> normals(points.size(), Point3f{});
  for (const Triangle& triangle : triangles) {
    const Point3f normal = face_normal(points, triangle);
    for (const std::uint32_t corner : triangle) add_agreeing(normals[first[corner]], normal);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] == i) normalize(normals[i]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) normals[i] = normals[first[i]];
  return normals;
}

}  // namespace marrow
