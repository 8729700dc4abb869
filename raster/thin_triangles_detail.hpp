// Thin triangles, for those who know already which are large.
#pragma once

#include "lattice_triangle_detail.hpp"

namespace marrow {

/// trace_thin_triangles() where `large` holds all triangles with three pixel centres and more along
/// a side.
void trace_thin(BitImage& mask, const SnappedPoints& points, std::span<const Triangle> triangles,
                const PackedTriangles& large, int resolution);

/// Where an image holds the whole square of which this is the lowest, leftmost pixel. `side` is a
/// power of two.
BitImage squares_within(BitImage image, int side);

/// Those of `triangles` of which four squares within an image, in the corners of the box of their
/// pixels, do not show that the image holds the box; also all wider than two squares.
PackedTriangles not_within(const BitImage& squares, int side, const PackedTriangles& triangles,
                           int shift);

/// Whether the image holds the pixels of all points.
bool holds_all(const BitImage& image, const SnappedPoints& points, int shift);

}  // namespace marrow
