// What can be counted on a shape without skeletonising it.
#pragma once

#include <marrow/bounds.hpp>
#include <marrow/shape.hpp>

#include <cstddef>
#include <optional>

namespace marrow {

/// Counts after welding: points at the same place are one, whatever the file says.
struct ShapeSummary {
  std::size_t points = 0, triangles = 0;  ///< as they are in the file
  std::size_t unused_points = 0;          ///< of no triangle; 0 when there are no triangles
  std::size_t flat_triangles = 0;         ///< with two corners at one place
  std::size_t components = 0;             ///< connected by shared places; 0 without triangles
  std::size_t open_edges = 0;             ///< of one triangle only
  std::size_t crowded_edges = 0;          ///< of three triangles or more
  std::optional<std::size_t> handles;     ///< of closed shapes, two triangles at every edge
  Bounds bounds;                          ///< of the used points

  bool is_closed() const { return triangles > flat_triangles && open_edges == 0; }
};

ShapeSummary summarize(const Shape& shape);

}  // namespace marrow
