// Leaves that end at the rim of a sheet, where a curve-skeleton has none.
#pragma once

#include <marrow/surface_scene.hpp>
#include <marrow/visual_hull.hpp>
#include <marrow/vote_graph.hpp>

#include <functional>

namespace marrow {

/// Makes the surface ready for questions; called where it is needed.
using AskSurface = std::function<const SurfaceScene&()>;

/// Cuts the leaf branches that run within a flat part no longer than it is wide: the medial axis of
/// a disc (a flange, a table top) is a sheet, and a line to its rim is one of many alike. A limb is
/// longer than wide, or not flat.
VoteGraph cut_leaves_in_sheets(const VoteGraph& graph, const Projections& projections,
                               const AskSurface& surface);

}  // namespace marrow
