// Leaves that end at the rim of a sheet, where a curve-skeleton has none or one.
#pragma once

#include <marrow/surface_scene.hpp>
#include <marrow/visual_hull.hpp>
#include <marrow/vote_graph.hpp>

#include <functional>

namespace marrow {

/// Makes the surface ready for questions; called where it is needed.
using AskSurface = std::function<const SurfaceScene&()>;

/// Cuts the leaf branches that run to the convex rim, or a corner, of a flat part, where they are
/// not longer than it is wide: the medial axis of a disc (a flange, a table top) is a sheet, and a
/// line to its rim is one of many alike. A limb is longer than wide, not flat, or has a notch
/// beside it. The end of a flat bar is one leaf, not two in its corners.
VoteGraph cut_leaves_in_sheets(const VoteGraph& graph, const Projections& projections,
                               const AskSurface& surface);

}  // namespace marrow
