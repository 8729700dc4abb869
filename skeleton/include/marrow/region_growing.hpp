// Ordered region growing (ORG, section 4.3): a spanning tree through the votes, the strongest
// first.
#pragma once

#include <marrow/vote_graph.hpp>

namespace marrow {

/// One tree per 26-connected region of the votes with support >= 8, grown from the strongest voxel,
/// always by the strongest neighbour: key (support, votes, radius, lower index). Regions with less
/// than 2 % of the greatest region's support are dropped. Nodes are in the order of growth: every
/// parent comes before its children, and each edge is {parent, child}.
/// `pixel` is the length of a pixel: radii of votes are thirds of it.
VoteGraph grow_spanning_tree(const VoteGrid& votes, double pixel);

}  // namespace marrow
