// Nodes of a curve-skeleton at even distances.
#pragma once

#include <marrow/curve_skeleton.hpp>

namespace marrow {

/// Nodes along every branch at equal steps, about `spacing` long, in the units of the shape. Ends
/// of branches stay, also the first node of a cycle without a joint; so do nodes alone, and the
/// topology: where two branches have the same ends, each keeps a node between them, and a branch
/// that ends where it begins keeps two. Places and radii between old nodes are interpolated. Nodes
/// that stay come first, in their order, then the new ones branch by branch.
/// Throws Error: Usage (a spacing that is not greater than 0), Limit (over 100 million nodes).
CurveSkeleton resample(const CurveSkeleton& skeleton, double spacing);

/// The same with steps of `share` times the radius where they are: fine where the shape is thin.
CurveSkeleton resample_by_radius(const CurveSkeleton& skeleton, double share);

}  // namespace marrow
