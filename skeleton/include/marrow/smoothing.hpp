// Tips and smoothing (section 4.4, last paragraph).
#pragma once

#include <marrow/vote_graph.hpp>

namespace marrow {

/// Takes nodes with a support under 21 of 42 off the leaves, at most r_leaf + 2 voxels of length,
/// and never a whole branch.
VoteGraph trim_leaves(const VoteGraph& graph, double voxel);

/// `passes` times, every node with two edges moves halfway to the middle of its neighbours; joints
/// and leaves stay.
VoteGraph smooth_branches(VoteGraph graph, int passes);

}  // namespace marrow
