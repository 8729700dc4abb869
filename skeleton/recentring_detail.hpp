// Lines into the middle of the surface.
#pragma once

#include <vector>

#include "branch_lines_detail.hpp"
#include "surface_probe_detail.hpp"

namespace marrow {

/// Moves all points to where opposite walls are as far, the lines held by their stiffness; points
/// outside the surface go into the limb beside them first. Radii are rough from here on.
void recentre(std::vector<BranchLine>& lines, const SurfaceProbe& probe, int rounds);

/// Moves joints to where the limbs that meet there point to, and lets their lines run straight
/// there from where each limb is alone.
void meet_at_joints(std::vector<BranchLine>& lines, const SurfaceProbe& probe);

/// A point with its radius, known to be at most `most`.
LinePoint measured(const Vec3& p, const SurfaceProbe& probe, double most = SurfaceProbe::kFar);

/// Sets the radii to the distances to the surface.
void measure(BranchLine& line, const SurfaceProbe& probe);

/// Adds points where an edge runs through a wall, pulled into the shape.
void mend_edges(BranchLine& line, const SurfaceProbe& probe);

/// A leaf at the end of the line that has run into one of several corners of a blunt end, such as a
/// foot, goes back to where the limb is whole: which corner it was is chance.
void leave_corner(BranchLine& line, const SurfaceProbe& probe);

/// Leaves run on, or back, to where their ball touches the end of the limb; none runs into the ball
/// of another line.
void settle_tips(std::vector<BranchLine>& lines, const SurfaceProbe& probe);

/// Mean half widths of the sections; near joints they fade to the radius.
void measure_sections(BranchLine& line, const SurfaceProbe& probe);

}  // namespace marrow
