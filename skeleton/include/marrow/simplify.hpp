// Fewer nodes for the same lines.
#pragma once

#include <marrow/curve_skeleton.hpp>

namespace marrow {

/// Takes out nodes within branches (Douglas and Peucker) as long as those that are left stand for
/// them: no node is farther than `tolerance` from the new lines, nor is its radius farther than
/// that from the one interpolated there. Ends of branches, nodes alone and the topology stay, as
/// resample() keeps them; nodes keep their order. Throws Error: Usage (a tolerance that is not
/// finite or below 0).
CurveSkeleton simplify(const CurveSkeleton& skeleton, double tolerance);

}  // namespace marrow
