// Taking small end branches off a curve-skeleton.
#pragma once

#include <marrow/curve_skeleton.hpp>

namespace marrow {

/// What is too small to stay, in the units of the shape.
struct PruneOptions {
  double length = 0;  ///< end branches shorter than this go
  double radius = 0;  ///< and those whose mean radius along their length is below this
};

/// Takes off branches from a joint to a leaf that are too short or too thin, the shortest first;
/// where a joint is left with two branches, they are one from then on, and judged as such. Parts
/// stay, whatever their size, and so do cycles. Nodes and edges keep their order.
/// Throws Error: Usage (a limit that is not finite or below 0).
CurveSkeleton prune(const CurveSkeleton& skeleton, const PruneOptions& options);

}  // namespace marrow
