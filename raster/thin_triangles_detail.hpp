// Thin triangles, for those who know already which are large.
#pragma once

#include <marrow/silhouette.hpp>

namespace marrow {

/// trace_thin_triangles() where `large` names all triangles whose boxes hold three pixel centres
/// and more along a side.
void trace_thin(BitImage& mask, const SnappedPoints& points, std::span<const Triangle> triangles,
                std::span<const std::uint32_t> large, int resolution);

/// The pixel of a lattice coordinate.
inline int nearest_pixel(int coordinate, int shift) {
  return (coordinate + (1 << shift) / 2) >> shift;
}

/// Whether the pixels of all points are set.
bool holds_all(const BitImage& image, const SnappedPoints& points, int shift);

}  // namespace marrow
