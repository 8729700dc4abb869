// The fill of many triangles at once.
#pragma once

#include <marrow/silhouette.hpp>

namespace marrow {

/// Which triangles to fill. Where every edge of a surface is run through as often in either
/// direction, a point that a clockwise triangle holds is held by a counter-clockwise one too (or by
/// one without area), so that half of them may go.
enum class Facing { Both, CounterClockwise };

struct TriangleFill {
  BitImage mask;
  std::vector<std::uint32_t> large;  ///< boxes of three pixels and more along a side
};

TriangleFill fill(const SnappedPoints& points, std::span<const Triangle> triangles, Facing facing,
                  int resolution);

}  // namespace marrow
