// What a mesh is, found out the slow and simple way.
#pragma once

#include <marrow/shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace marrow::test {

struct MeshFacts {
  int components = 0;
  int euler = 0;           ///< points - edges + triangles
  int boundary_edges = 0;  ///< have one triangle
  int bad_edges = 0;       ///< have two triangles that run the same way, or more than two
  int bad_points = 0;      ///< used by no triangle, or by fans that touch in this point only
  int flat_triangles = 0;  ///< have no area

  bool is_closed_manifold() const {
    return boundary_edges == 0 && bad_edges == 0 && bad_points == 0 && flat_triangles == 0;
  }
};

/// Labels that are joined.
class Groups {
 public:
  explicit Groups(std::size_t count) : label_(count) {
    std::iota(label_.begin(), label_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (label_[i] != i) i = label_[i] = label_[label_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { label_[find(a)] = find(b); }
  int count() {
    int roots = 0;
    for (std::size_t i = 0; i < label_.size(); ++i) roots += find(i) == i;
    return roots;
  }

 private:
  std::vector<std::size_t> label_;
};

inline double area_of(const Shape& shape, const Triangle& t) {
  const auto& p = shape.points;
  return length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
}

/// Fans of triangles around all points: one for each point of a manifold.
inline int fan_count(const Shape& shape) {
  const std::size_t triangles = shape.triangles.size();
  Groups corners(3 * triangles);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::size_t, 2>> first_user;
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    const Triangle& t = shape.triangles[i / 3];
    const std::size_t next = i / 3 * 3 + (i + 1) % 3;
    const std::uint32_t a = t[i % 3];
    const std::uint32_t b = t[(i + 1) % 3];
    const std::array<std::size_t, 2> at = a < b ? std::array{i, next} : std::array{next, i};
    const auto [found, is_new] = first_user.try_emplace(std::minmax(a, b), at);
    if (is_new) continue;
    corners.join(found->second[0], at[0]);
    corners.join(found->second[1], at[1]);
  }
  return corners.count();
}

inline MeshFacts facts_of(const Shape& shape) {
  MeshFacts facts;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> uses;  // up, down
  Groups pieces(shape.points.size());
  for (const Triangle& t : shape.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      auto& [up, down] = uses[std::minmax(a, b)];
      ++(a < b ? up : down);
      pieces.join(a, b);
    }
    facts.flat_triangles += area_of(shape, t) < 1e-9;
  }
  for (const auto& [edge, use] : uses) {
    facts.boundary_edges += use.first + use.second == 1;
    facts.bad_edges += use.first > 1 || use.second > 1;
  }
  facts.components = pieces.count();
  facts.euler = static_cast<int>(shape.points.size()) - static_cast<int>(uses.size()) +
                static_cast<int>(shape.triangles.size());
  facts.bad_points = std::abs(fan_count(shape) - static_cast<int>(shape.points.size()));
  return facts;
}

inline double volume_of(const Shape& shape) {
  double sum = 0;
  for (const Triangle& t : shape.triangles) {
    sum += dot(shape.points[t[0]], cross(shape.points[t[1]], shape.points[t[2]]));
  }
  return sum / 6;
}

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 span = b - a;
  const double t = std::clamp(dot(p - a, span) / squared_length(span), 0.0, 1.0);
  return distance(p, a + span * t);
}

inline double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = normalized(cross(b - a, c - a));
  const bool is_above = dot(cross(b - a, p - a), normal) >= 0 &&
                        dot(cross(c - b, p - b), normal) >= 0 &&
                        dot(cross(a - c, p - c), normal) >= 0;
  if (is_above) return std::abs(dot(p - a, normal));
  return std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

inline double distance_to_surface(const Shape& shape, const Vec3& p) {
  double nearest = std::numeric_limits<double>::max();
  for (const Triangle& t : shape.triangles) {
    const Vec3 &a = shape.points[t[0]], &b = shape.points[t[1]], &c = shape.points[t[2]];
    const double bound = distance(p, a) - distance(a, b) - distance(a, c);
    if (bound < nearest) nearest = std::min(nearest, distance_to_triangle(p, a, b, c));
  }
  return nearest;
}

/// How often the surface goes around `p`: 0 outside, 1 inside, more where parts overlap.
inline int winding_number(const Shape& shape, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : shape.triangles) {
    const Vec3 a = shape.points[t[0]] - p;
    const Vec3 b = shape.points[t[1]] - p;
    const Vec3 c = shape.points[t[2]] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return static_cast<int>(std::lround(sum / (2 * std::numbers::pi)));
}

/// The edges of a sheet that have one triangle.
inline std::vector<std::pair<Vec3, Vec3>> boundary_of(const Shape& shape) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Triangle& t : shape.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  }
  std::vector<std::pair<Vec3, Vec3>> boundary;
  for (const auto& [edge, count] : uses) {
    if (count == 1) boundary.emplace_back(shape.points[edge.first], shape.points[edge.second]);
  }
  return boundary;
}

}  // namespace marrow::test
