#include <marrow/view.hpp>

#include <cstdlib>

#include "enclosure_detail.hpp"

namespace marrow {

namespace {

constexpr double kFarAway = 8;  // in the frame whose shape lies in the unit ball; p near it

// Crossings so near to each other are of one wall: of both triangles at an edge, or of a copy.
constexpr double kSameWall = 1e-6;

// Rays along the axes of a symmetric shape would run along its edges: the directions are turned.
constexpr Frame kTurned{
    {2.0 / 7, 3.0 / 7, 6.0 / 7}, {3.0 / 7, -6.0 / 7, 2.0 / 7}, {6.0 / 7, 2.0 / 7, -3.0 / 7}};

struct Crossings {
  int signs = 0;
  bool odd = false;  // walls
};

Crossings crossings(const SurfaceScene& surface, const Vec3& p, const Vec3& direction) {
  Crossings result;
  double last = -1;
  for (const SurfaceHit& hit : surface.all_hits(p, direction, kFarAway)) {
    result.signs += dot(surface.normal(hit.triangle), direction) > 0 ? 1 : -1;
    if (hit.distance - last > kSameWall) result.odd = !result.odd;
    last = hit.distance;
  }
  return result;
}

}  // namespace

bool encloses(const SurfaceScene& surface, const Vec3& p) {
  int signs = 0, odd = 0, directions = 0;
  for (const Vec3& turned : hemisphere_directions()) {
    const Vec3 direction = from_frame(kTurned, turned);
    for (const Vec3& way : {direction, -direction}) {
      const Crossings found = crossings(surface, p, way);
      signs += found.signs;
      odd += found.odd;
      ++directions;
    }
  }
  return 2 * std::abs(signs) > directions || 2 * odd > directions;
}

}  // namespace marrow
