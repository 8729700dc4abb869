#include <marrow/polygon.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "polygon_detail.hpp"

namespace marrow {

namespace polygon_detail {

std::optional<std::size_t> fan_apex(std::span<const Vec3> corners) {
  constexpr double kRounding = 1e-12;  // of the area: what rounding does to corners in line
  const std::size_t n = corners.size();
  if (n == 3) return 0;
  Vec3 normal;
  for (std::size_t i = 1; i + 1 < n; ++i)
    normal += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  const double area = squared_length(normal);
  // Outside of these bounds products overflow or lose their digits.
  if (!(area > 1e-200 && area < 1e200)) return {};
  const auto is_apex = [&](std::size_t apex) {
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Vec3& a = corners[(apex + i) % n];
      const Vec3& b = corners[(apex + i + 1) % n];
      if (!(dot(cross(a - corners[apex], b - corners[apex]), normal) >= -kRounding * area))
        return false;
    }
    return true;
  };
  for (std::size_t apex = 0; apex < 2; ++apex)
    if (is_apex(apex)) return apex;
  return {};
}

}  // namespace polygon_detail

namespace {

using namespace polygon_detail;

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

/// Multiplies by the power of two that brings the largest coordinate into 1/2..1: exact, but for
/// digits below the smallest double.
void scale_to_one(std::vector<Vec3>& points) {
  int exponent = 0;
  std::frexp(largest_coordinate(points), &exponent);
  for (Vec3& p : points)
    p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
}

/// The corners seen from the first one, in a unit in which the largest coordinate is about 1.
std::vector<Vec3> local_corners(std::span<const Vec3> corners) {
  std::vector<Vec3> local(corners.begin(), corners.end());
  scale_to_one(local);
  const Vec3 origin = local[0];
  for (Vec3& p : local) p = p - origin;
  scale_to_one(local);
  return local;
}

Vec3 mean_normal(const std::vector<Vec3>& local) {
  Vec3 normal;
  for (std::size_t i = 1; i + 1 < local.size(); ++i) normal += cross(local[i], local[i + 1]);
  return normal;
}

/// The normal of the largest triangle on the longest diagonal from the first corner: for polygons
/// such as a figure eight, whose mean normal vanishes.
Vec3 widest_normal(const std::vector<Vec3>& local) {
  const auto by_length = [](const Vec3& a, const Vec3& b) {
    return squared_length(a) < squared_length(b);
  };
  const Vec3 axis = *std::max_element(local.begin(), local.end(), by_length);
  Vec3 widest;
  for (const Vec3& p : local) widest = std::max(widest, cross(axis, p), by_length);
  return widest;
}

/// The corners in the plane of the polygon; empty if it has no area in any plane.
std::vector<std::array<double, 2>> flatten(const std::vector<Vec3>& local) {
  constexpr double kSmallest = 1e-9;  // below it, the mean normal is rounding
  Vec3 normal = mean_normal(local);
  if (length(normal) < kSmallest) normal = widest_normal(local);
  if (!(length(normal) > 1e-100)) return {};
  const Vec3 z = normalized(normal);
  // The unit vector that is farthest from z gives the first axis.
  Vec3 other{1, 0, 0};
  if (std::abs(z.y) < std::abs(z.x) && std::abs(z.y) <= std::abs(z.z)) other = {0, 1, 0};
  if (std::abs(z.z) < std::abs(z.x) && std::abs(z.z) < std::abs(z.y)) other = {0, 0, 1};
  const Vec3 x = normalized(cross(other, z)), y = cross(z, x);
  std::vector<std::array<double, 2>> flat;
  flat.reserve(local.size());
  for (const Vec3& p : local) flat.push_back({dot(x, p), dot(y, p)});
  return flat;
}

/// The outline on the integer grid. `local` coordinates are at most 1, flat ones at most sqrt(3).
PlaneGraph snap(const std::vector<std::array<double, 2>>& flat) {
  constexpr double kGrid = 1 << 28;
  PlaneGraph graph;
  const auto n = static_cast<std::uint32_t>(flat.size());
  graph.nodes.reserve(n);
  graph.edges.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    graph.nodes.push_back({static_cast<std::int64_t>(std::floor(flat[i][0] * kGrid + 0.5)),
                           static_cast<std::int64_t>(std::floor(flat[i][1] * kGrid + 0.5)), i});
    graph.edges.push_back({i, (i + 1) % n, 1});
  }
  tidy(graph);
  return graph;
}

std::vector<Triangle> fan(std::size_t corner_count, std::size_t apex) {
  std::vector<Triangle> triangles;
  triangles.reserve(corner_count);
  for (std::size_t i = 1; i + 1 < corner_count; ++i)
    triangles.push_back({static_cast<std::uint32_t>(apex),
                         static_cast<std::uint32_t>((apex + i) % corner_count),
                         static_cast<std::uint32_t>((apex + i + 1) % corner_count)});
  return triangles;
}

/// The edges alone, for a polygon without an inside.
std::vector<Triangle> edges(std::size_t corner_count) {
  std::vector<Triangle> triangles;
  triangles.reserve(corner_count);
  const auto n = static_cast<std::uint32_t>(corner_count);
  for (std::uint32_t i = 0; i < n; ++i) triangles.push_back({i, (i + 1) % n, (i + 1) % n});
  return triangles;
}

}  // namespace

PolygonCut cut_polygon(std::span<const Vec3> corners) {
  const std::size_t n = corners.size();
  if (n < 3) return {};
  if (const auto apex = fan_apex(corners)) return {fan(n, *apex), {}};

  const auto flat = flatten(local_corners(corners));
  if (flat.empty()) return {edges(n), {}};
  PlaneGraph graph = snap(flat);
  std::vector<Vec3> points(corners.begin(), corners.end());
  std::int64_t budget = 400'000'000;
  // Rounding a crossing to the grid moves edges and can make them cross anew, but rarely twice.
  constexpr int kMaxRounds = 12;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (auto triangles = triangulate(graph)) {
      if (triangles->empty()) return {edges(n), {}};
      return {std::move(*triangles),
              {points.begin() + static_cast<std::ptrdiff_t>(n), points.end()}};
    }
    // More pieces than n straight edges can cut each other into are made by rounding alone.
    if (graph.edges.size() > n * n || !split_crossings(graph, points, budget)) break;
  }
  return {fan(n, 0), {}};
}

}  // namespace marrow
