// Branch collapse (section 4.4.2), and cycles that the grid cannot tell.
#pragma once

#include <marrow/vote_graph.hpp>

namespace marrow {

/// Merges joints whose balls intersect, smallest d / (r1 + r2) first, into their barycentre
/// weighted by the joints merged so far, with the lesser radius; only where the two balls, one
/// voxel larger, cover the branch between them, so that a handle never contracts. With voxels of
/// infinite size that is not asked: the paper's own rule, for trees.
VoteGraph collapse_branches(const VoteGraph& graph, double voxel);

/// Cuts branches that lie on a cycle, the least supported first: welds (at most 6 voxels long with
/// a support under 21 of 42 somewhere inside) and cycles shorter than 12 voxels.
VoteGraph cut_short_cycles(const VoteGraph& graph, double voxel);

}  // namespace marrow
