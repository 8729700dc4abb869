// Loops of a tree, by the paper's own rule (section 4.4.3).
#pragma once

#include <marrow/vote_graph.hpp>

namespace marrow {

/// Joins leaves whose balls meet by an edge, the deepest overlap first, every leaf once (Fig. 9c):
/// where the tree has broken a loop, its two ends are that near. So are the tips of limbs side by
/// side, which makes false loops.
VoteGraph recover_loops(VoteGraph graph);

}  // namespace marrow
