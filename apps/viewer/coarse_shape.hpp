// A shape made small enough for a page.
#pragma once

#include <marrow/shape.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// What one page has room for: about a megabyte and a half as text, indices of 16 bits.
struct PageRoom {
  std::size_t points = 60'000, triangles = 110'000;
};

/// A shape on a lattice of 2^16 steps along every axis.
struct CoarseShape {
  std::vector<std::array<std::uint16_t, 3>> points;
  std::vector<std::array<std::uint16_t, 3>> triangles;
  std::vector<std::uint32_t> source;  ///< for every point, one of those that it stands for
};

/// `places` are the points of a shape within -1 to 1 along every axis. Points in one cell of a grid
/// become their mean, triangles with two corners in one cell go, of several with the same corners
/// one stays. The grid is as fine as the room allows: that of the lattice where all fits. Without
/// triangles all points count, else those of triangles.
CoarseShape coarsened(std::span<const Vec3> places, std::span<const Triangle> triangles,
                      const PageRoom& room = {});

}  // namespace marrow
