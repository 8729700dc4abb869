// Tips and smoothing (section 4.4, last paragraph).
#pragma once

#include <marrow/vote_graph.hpp>

namespace marrow {

/// Takes nodes with a support under 21 of 42 off the leaves, at most r_leaf + 2 voxels of length,
/// and never a whole branch.
VoteGraph trim_leaves(const VoteGraph& graph, double voxel);

/// Cuts hooks off the leaves: where a leaf branch runs to the end of a limb and back again, so that
/// the ball of its leaf runs into that of a node at least twice as far along the branch as across,
/// it ends at the turn. Balls of limbs that only touch do not run into each other; all that is cut
/// runs into the rest of the branch, by more than a voxel.
VoteGraph cut_hooks(const VoteGraph& graph, double voxel);

/// `passes` times, every node with two edges moves halfway to the middle of its neighbours; joints
/// and leaves stay.
VoteGraph smooth_branches(VoteGraph graph, int passes);

}  // namespace marrow
