// The core where the hull of voxels does not hold it.
#pragma once

#include <marrow/hull_topology.hpp>
#include <marrow/vote_graph.hpp>
#include <marrow/voxel_set.hpp>

namespace marrow {

/// Adds the voxels of the core: limbs thinner than a voxel are in no hull of voxels. Where the core
/// only bridges two places of the hull on weak support, it would weld what is apart. The hull of
/// samples has gaps: bridges that half of the images support are added there between parts that
/// nothing else joins.
void add_core(const VoxelGrid& grid, VoxelSet& hull, const VoteGraph& core, HullOf of);

}  // namespace marrow
