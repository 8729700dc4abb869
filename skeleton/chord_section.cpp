#include <algorithm>
#include <array>

#include "chord_section_detail.hpp"

namespace marrow {

namespace {

constexpr int kMostSteps = 64;
constexpr double kFar = 4;          // beyond the frame
constexpr double kLeastStep = 0.5;  // pixels

double pixel_of(const Projections& projections) {
  return PixelGrid{projections.image(0).distance.width()}.pixel();
}

struct Chord {
  double half;
  Vec3 middle;
};

Chord chord(const Vec3& p, const Vec3& direction, const FreeWay& free_way) {
  const double ahead = free_way(p, direction), back = free_way(p, -direction);
  return {0.5 * (ahead + back), p + direction * (0.5 * (ahead - back))};
}

}  // namespace

FreeWay free_way_in(const Projections& projections) {
  return [&projections, least = kLeastStep * pixel_of(projections)](const Vec3& from,
                                                                    const Vec3& direction) {
    double way = 0;
    for (int k = 0; k < kMostSteps; ++k) {
      const double radius = hull_radius(from + direction * way, projections);
      if (radius <= 0) break;
      way += std::max(radius, least);
    }
    return way;
  };
}

FreeWay free_way_in(const SurfaceScene& surface, const Projections& projections) {
  return [&surface, in_hull = free_way_in(projections)](const Vec3& from, const Vec3& direction) {
    const auto hit = surface.first_hit(from, direction, kFar);
    return hit ? hit->distance : in_hull(from, direction);
  };
}

std::array<Vec3, 16> directions_around(const Vec3& u, const Vec3& v) {
  constexpr double kRootHalf = 0.70710678118654752, kCosine = 0.92387953251128674,
                   kSine = 0.38268343236508977;
  const std::array<Vec3, 4> quarter{u, u * kCosine + v * kSine, (u + v) * kRootHalf,
                                    u * kSine + v * kCosine};
  std::array<Vec3, 16> all;
  for (std::size_t i = 0; i < quarter.size(); ++i) {
    const Vec3 turned = v * dot(quarter[i], u) - u * dot(quarter[i], v);
    all[i] = quarter[i];
    all[i + 4] = turned;
    all[i + 8] = -quarter[i];
    all[i + 12] = -turned;
  }
  return all;
}

ChordSection section_across(const Vec3& p, const Vec3& tangent, const FreeWay& free_way) {
  const Frame frame = frame_along(tangent);
  ChordSection section;
  const auto directions = directions_around(frame.x, frame.y);
  std::array<double, 8> halves;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const Chord c = chord(p, directions[i], free_way);
    halves[i] = c.half;
    if (i > 0 && c.half >= section.thinnest) continue;
    section.thinnest = c.half;
    section.normal = directions[i];
    section.middle = c.middle;
  }
  std::sort(halves.begin(), halves.end());
  section.median = 0.5 * (halves[halves.size() / 2 - 1] + halves[halves.size() / 2]);
  section.widest = halves.back();
  return section;
}

ChordSection turned_to_normal(ChordSection section, const FreeWay& free_way) {
  for (const double turn : {0.4, 0.2, 0.1, 0.05}) {
    const Frame frame = frame_along(section.normal);
    for (const Vec3& aside : {frame.x, -frame.x, frame.y, -frame.y}) {
      const Vec3 direction = normalized(frame.z + aside * turn);
      const double half = chord(section.middle, direction, free_way).half;
      if (half >= section.thinnest) continue;
      section.thinnest = half;
      section.normal = direction;
    }
  }
  return section;
}

}  // namespace marrow
