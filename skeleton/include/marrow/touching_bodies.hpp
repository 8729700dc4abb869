// Bodies of a point cloud that lie so close that the discs of their samples weld them
// (section 5.1).
#pragma once

#include <marrow/normalization.hpp>
#include <marrow/vote_graph.hpp>

#include <optional>

namespace marrow {

/// The votes that lie at least a spacing off every sample of the cloud: a graph that is thinned by
/// these keeps to the middle of thick parts, and passes through the surface where it must on the
/// shortest way.
VoteGrid votes_off_samples(VoteGrid votes, const NormalizedShape& cloud);

/// Parts what touches. A branch between two joints is a weld where it comes within half a spacing
/// of a sample and is deeper than 0.6 spacings on both sides of it: it passes through the surface.
/// Welds are cut where two bodies, which without all welds are apart, have two or more of them:
/// what is one body has a single neck, or comes together again elsewhere. Nothing where none is
/// cut.
std::optional<VoteGraph> part_bodies(const VoteGraph& graph, const NormalizedShape& cloud);

/// The graph without its nodes that have no edge, unless it has no others.
VoteGraph without_lone_nodes(const VoteGraph& graph);

}  // namespace marrow
