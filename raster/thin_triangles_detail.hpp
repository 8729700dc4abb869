// Thin triangles, for those who know already which are large.
#pragma once

#include "contour_fill_detail.hpp"

namespace marrow {

/// trace_thin_triangles() where `large` holds all triangles with three pixel centres and more along
/// a side.
void trace_thin(BitImage& mask, const SnappedPoints& points, std::span<const Triangle> triangles,
                const PackedTriangles& large, int resolution);

/// The pixels that contours run through and that are not in the 3x3 pixels around one of `mask`,
/// which is what they enclose; and maybe some more such pixels beside them. Whatever an oriented
/// surface shows lies within its contours or on one, but for triangles without area: only in these
/// pixels can it leave a trace.
BitImage far_contours(std::span<const ContourEdge> contours, const BitImage& mask);

/// Those of `triangles` with a pixel of `image` in the box of their pixels.
PackedTriangles near_to(const BitImage& image, const PackedTriangles& triangles);

/// trace_thin_triangles() of an oriented surface: `near` are all triangles near to its
/// far_contours(), `flat` all without area.
void trace_thin(BitImage& mask, const PackedTriangles& near, const PackedTriangles& flat);

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
