// Parts of a point cloud that only a gap in the sampling keeps apart (section 5.1).
#pragma once

#include <marrow/visual_hull.hpp>
#include <marrow/vote_graph.hpp>

namespace marrow {

/// Joins parts of the visual hull by lines of voxels across gaps of up to `reach` (normalised
/// frame). A line begins at a leaf of `core` and runs on in its direction, within 60 degrees, to
/// the nearest voxel of another part; the shortest ones first, and only between parts that are not
/// joined yet, so that no cycle is made. Parts without leaves, such as rings, stay as they are.
VoxelSet bridge_gaps(const VoxelGrid& grid, VoxelSet hull, const VoteGraph& core, double reach);

}  // namespace marrow
