#include <algorithm>
#include <cmath>

#include "sight_detail.hpp"

namespace marrow {

namespace {

constexpr double kSlack = 1e-12;  // more than rounding, where all coordinates are near 1
constexpr double kNear = 1e-6;    // of a line of sight: its end

Vec3 absolute(const Vec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

/// A line of sight, to be held against boxes by the planes that may separate the two.
class Segment {
 public:
  Segment(const Vec3& from, const Vec3& to)
      : middle_(0.5 * (from + to)), half_(0.5 * (to - from)), reach_(absolute(half_)) {}

  bool meets(const ReachBox& box) const {
    const Vec3 size = 0.5 * (box.high - box.low) + Vec3{box.reach, box.reach, box.reach};
    const Vec3 away = middle_ - 0.5 * (box.low + box.high);
    const Vec3 far = absolute(away);
    if (far.x > size.x + reach_.x + kSlack || far.y > size.y + reach_.y + kSlack ||
        far.z > size.z + reach_.z + kSlack)
      return false;
    const Vec3 moment = absolute(cross(half_, away));
    return moment.x <= size.y * reach_.z + size.z * reach_.y + kSlack &&
           moment.y <= size.x * reach_.z + size.z * reach_.x + kSlack &&
           moment.z <= size.x * reach_.y + size.y * reach_.x + kSlack;
  }

 private:
  Vec3 middle_, half_, reach_;
};

/// Whether the line meets the triangle before its end (Möller and Trumbore, 1997).
bool meets_triangle(const Vec3& from, const Vec3& line, const Vec3& a, const Vec3& b,
                    const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 p = cross(line, ac);
  const double volume = dot(ab, p);
  if (volume == 0) return false;
  const Vec3 s = from - a;
  const double u = dot(s, p) / volume;
  if (!(u >= 0 && u <= 1)) return false;
  const Vec3 q = cross(s, ab);
  const double v = dot(line, q) / volume;
  if (!(v >= 0 && u + v <= 1)) return false;
  const double t = dot(ac, q) / volume;
  return t > 0 && t < 1 - kNear;
}

}  // namespace

SurfaceSight::SurfaceSight(std::span<const Vec3> points, std::span<const Triangle> triangles)
    : points_(points), triangles_(triangles) {
  std::vector<ReachBox> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    boxes.push_back({points[a], points[a]});
    boxes.back().add(points[b]);
    boxes.back().add(points[c]);
  }
  tree_.emplace(boxes);
}

bool SurfaceSight::is_free(const Vec3& from, const Vec3& to) const {
  const Segment sight(from, to);
  const Vec3 line = to - from;
  return !tree_->any([&](const ReachBox& box) { return sight.meets(box); },
                     [&](std::uint32_t t) {
                       const auto& [a, b, c] = triangles_[t];
                       return meets_triangle(from, line, points_[a], points_[b], points_[c]);
                     });
}

CloudSight::CloudSight(std::span<const Vec3> points, std::span<const double> spacing)
    : points_(points), spacing_(spacing) {
  std::vector<ReachBox> boxes;
  boxes.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    boxes.push_back({points[i], points[i], spacing[i]});
  tree_.emplace(boxes);
}

bool CloudSight::is_free(const Vec3& from, std::uint32_t to) const {
  constexpr double kOwn = 1.5;  // spacings around the point that are its own surface
  const Vec3 end = points_[to];
  const Segment sight(from, end);
  const Vec3 line = end - from;
  const double squared = squared_length(line);
  if (squared == 0) return true;
  return !tree_->any([&](const ReachBox& box) { return sight.meets(box); },
                     [&](std::uint32_t q) {
                       const double own = kOwn * std::max(spacing_[q], spacing_[to]);
                       if (squared_length(points_[q] - end) <= own * own) return false;
                       const double along =
                           std::clamp(dot(points_[q] - from, line) / squared, 0.0, 1.0);
                       const double radius = 0.5 * spacing_[q];
                       return squared_length(from + along * line - points_[q]) < radius * radius;
                     });
}

}  // namespace marrow
