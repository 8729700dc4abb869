// Where a line leaves the shape, and whether it had to.
#pragma once

#include <marrow/normalization.hpp>
#include <marrow/vec.hpp>

#include <span>
#include <vector>

namespace marrow {

/// How far from the surface the line through `samples` gets where it runs outside; 0 where it does
/// not, or where the ends of a piece outside are connected inside the shape within a voxel of it. A
/// piece that gets beyond `hollow` is not asked for a detour.
double farthest_excursion(std::span<const Vec3> samples, const NormalizedShape& shape, double voxel,
                          double hollow);

}  // namespace marrow
