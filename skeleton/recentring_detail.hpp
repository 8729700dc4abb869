// Lines into the middle of the surface.
#pragma once

#include <vector>

#include "branch_lines_detail.hpp"
#include "surface_probe_detail.hpp"

namespace marrow {

/// Moves the points of a line that lie outside the surface into the limb beside them.
void bring_inside(BranchLine& line, const SurfaceProbe& probe);

/// Moves the points of a line to where opposite walls are as far, the line held by its stiffness;
/// no point leaves the ball that it starts with. Radii are those of the new places.
void recentre(BranchLine& line, const SurfaceProbe& probe);

/// Adds points where an edge may run through a wall, pulled to the middle.
void mend_edges(BranchLine& line, const SurfaceProbe& probe);

/// Leaves run on, or back, to where their ball touches the end of the limb; none runs into the ball
/// of another line.
void settle_tips(std::vector<BranchLine>& lines, const SurfaceProbe& probe);

/// Mean half widths of the sections; near joints they fade to the radius.
void measure_sections(BranchLine& line, const SurfaceProbe& probe);

}  // namespace marrow
