// The topology of the visual hull, in place of the loop recovery of section 4.4.3.
#pragma once

#include <marrow/vote_graph.hpp>
#include <marrow/voxel_set.hpp>

#include <span>

namespace marrow {

/// What a hull is of. One of samples has gaps where these are sparse.
enum class HullOf { Body, Samples };

/// The solid that is thinned: the hull and the voxels of the pruned tree, but for pieces of the
/// tree that bridge two places of the hull with a mean support under 26 of 42 (of samples: under 21
/// where nothing else joins these places); without the parts that have less than 2 % of the
/// greatest part's support.
VoxelSet supported_solid(const VoxelGrid& grid, VoxelSet hull, const VoteGrid& votes,
                         const VoteGraph& core, HullOf of = HullOf::Body);

/// Thins the solid, unvoted voxels first by depth, then voted ones by support, with the leaves of
/// `core` as anchors. What is left has the components, cycles and connections of the solid. `depth`
/// is distance_transform() of the solid.
VoxelSet thin_by_votes(const VoteGrid& votes, const VoxelSet& solid,
                       std::span<const ChamferDistance> depth, const VoteGraph& core);

/// The graph of a thin part of the solid: 26-adjacency without the longest edge of every triangle.
/// Voted voxels stand at the mean of their votes, others at their centres, with the radius that
/// their depth gives them. `pixel` is the length of a pixel.
VoteGraph graph_of(const VoteGrid& votes, const VoxelSet& solid,
                   std::span<const ChamferDistance> depth, const VoxelSet& thin_set, double pixel);

}  // namespace marrow
