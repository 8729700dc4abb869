// Cycles that the silhouettes promise and the surface denies.
#pragma once

#include <marrow/surface_sides.hpp>
#include <marrow/vote_graph.hpp>

namespace marrow {

/// Cuts two kinds of false cycles, asking the surface. Where the surface has no
/// say (soups, large holes) nothing is cut.
/// - A branch that leaves the shape: limbs that touch in all 42 silhouettes weld where nothing is.
/// A
///   branch between joints is cut when it runs outside, unless its two ends are connected inside
///   close by (then it only cuts a corner), or it gets farther than 6 voxels from the surface: such
///   a hollow is the inside of a cup.
/// - A cycle around nothing: when the disc that it spans lies inside the shape it can be contracted
///   there, and its least supported branch is cut.
VoteGraph cut_false_cycles(const VoteGraph& graph, SurfaceSides& surface, double voxel);

/// The first of these two cuts alone, and only of branches on cycles: to be done before joints
/// merge. Where two rings touch twice, a joint merged from both sides would hold them together for
/// good.
VoteGraph cut_welds(const VoteGraph& graph, SurfaceSides& surface, double voxel);

/// Cuts branches on cycles, the least supported first, until no more than `most_cycles` are left
/// (the genus, for a shape whose surface is one closed manifold) or every cycle is a part by
/// itself.
VoteGraph cut_surplus_cycles(const VoteGraph& graph, int most_cycles);

}  // namespace marrow
