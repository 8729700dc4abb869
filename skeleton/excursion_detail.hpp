// Where a line leaves the shape, and whether it had to.
#pragma once

#include <marrow/surface_sides.hpp>

#include <span>
#include <vector>

namespace marrow {

/// A point of a line and what the surface says of it.
struct LineSample {
  Vec3 position;
  PointSide surface;
};

/// How far from the surface the line through `samples` gets where it runs outside; 0 where it does
/// not, or where the ends of a piece outside are connected inside the shape within a voxel of it. A
/// piece that gets beyond `hollow` is not asked for a detour.
double farthest_excursion(std::span<const LineSample> samples, const SurfaceSides& surface,
                          double voxel, double hollow);

}  // namespace marrow
