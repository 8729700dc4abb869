// The fill of many triangles at once.
#pragma once

#include <marrow/silhouette.hpp>

#include "lattice_triangle_detail.hpp"

namespace marrow {

/// Which triangles to fill. Where every edge of a surface is run through as often in either
/// direction, a point that a clockwise triangle holds is held by a counter-clockwise one too (or by
/// one without area), so that half of them may go.
enum class Facing { Both, CounterClockwise };

inline Facing facing_of(const NormalizedShape& shape) {
  return shape.oriented ? Facing::CounterClockwise : Facing::Both;
}

struct TriangleFill {
  BitImage mask;
  PackedTriangles large;  ///< those of three pixel centres and more along a side
};

/// Row by row.
void fill_large(BitImage& mask, const PackedTriangles& triangles, Facing facing, int shift);

TriangleFill fill(const SnappedPoints& points, std::span<const Triangle> triangles, Facing facing,
                  int resolution);

}  // namespace marrow
