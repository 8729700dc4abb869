// The fill of an oriented surface by its contours.
#pragma once

#include "lattice_triangle_detail.hpp"

namespace marrow {

/// An edge on the lattice; what it bounds lies to its left.
struct ContourEdge {
  LatticePoint from, to;
};

/// The pixels whose centre lies within closed contours or on one of them. How often the contours
/// run around a pixel is never negative.
BitImage fill_contours(std::span<const ContourEdge> contours, int resolution);

}  // namespace marrow
