// A line held by targets and by its own stiffness.
#pragma once

#include <span>
#include <vector>

#include "branch_lines_detail.hpp"
#include "symmetric3_detail.hpp"

namespace marrow {

/// Where a point of a line is drawn to, and how firmly along each direction.
struct Target {
  Vec3 place;
  Symmetric3 weight;
};

/// The places of all points that minimise
///   sum of s (x - place)' weight (x - place) + sum of stiffness |x''|^2 s
/// with s the share of the line's length that a point stands for. `stiffness` has the unit of a
/// length to the fourth power. Fixed ends keep their place.
std::vector<Vec3> relax(const BranchLine& line, std::span<const Target> targets,
                        std::span<const double> stiffness);

}  // namespace marrow
