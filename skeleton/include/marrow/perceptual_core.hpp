// The perceptual core (section 4.4.1): branches that tell something of the shape.
#pragma once

#include <marrow/vote_graph.hpp>

namespace marrow {

/// Whose balls must not all touch that of a joint: those of its leaves, as the paper has it, or
/// those along the ways to them. A line that turns round at the end of a limb may have its leaf
/// back beside the joint.
enum class Zone { OfLeaves, OfWays };

/// Prunes a spanning forest, in one pass from the leaves up to the middle of each tree's longest
/// path: at a joint a leaf survives when its ball, or one on the way to it, does not touch the
/// joint's, and always the most significant one: that with the greatest sum of
/// length * (support / 42)^3 along its way.
VoteGraph prune_by_zone_of_influence(const VoteGraph& forest, Zone zone);

/// The same again and again until no leaf goes: the paper's own rule.
VoteGraph prune_to_convergence(VoteGraph forest);

/// The leaf rule. With U the length of a leaf branch outside all balls of the rest (those with less
/// than 0.6 of a node's support do not hold it), and M the mean
/// broad support over that part, a branch goes while U < r_leaf + 2 voxels or
/// U / (r_leaf + 2 voxels) * (M / 42)^3 < 0.36; the least telling first, scores taken anew.
/// A part that is a single path stays. Works on any graph, with or without cycles.
VoteGraph prune_leaves(const VoteGraph& graph, double voxel);

/// Both, one after the other.
VoteGraph extract_perceptual_core(const VoteGraph& forest, double voxel);

}  // namespace marrow
