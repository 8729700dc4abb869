// Which triangles share an edge.
#pragma once

#include <marrow/shape.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace marrow {

/// For every triangle those that run through its edges in the other direction; edge i goes from
/// corner i to the next. Where many triangles share an edge, they are paired in any way. Empty when
/// some edge is left alone, and where it would take too long to find out. `points` is greater than
/// any corner.
std::vector<Triangle> edge_neighbours(std::span<const Triangle> triangles, std::size_t points);

}  // namespace marrow
