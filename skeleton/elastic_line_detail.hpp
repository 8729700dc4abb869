// Lines held by targets and by their own stiffness, and by the joints that they share.
#pragma once

#include <span>
#include <vector>

#include "branch_lines_detail.hpp"
#include "symmetric3_detail.hpp"

namespace marrow {

/// What one point of a line is drawn by.
struct Hold {
  Vec3 place;
  Symmetric3 weight;     ///< how firmly along each direction
  double stiffness = 0;  ///< against bending, in the unit of a length to the fourth power
};

/// One hold for every point of every line.
using Holds = std::vector<std::vector<Hold>>;

/// The places of all points that minimise, over all lines,
///   sum of s (x - place)' weight (x - place) + sum of s stiffness |x''|^2
/// with s the share of its line's length that a point stands for. A joint is one point of all its
/// lines; nothing bends there, so that it lies where they lead.
std::vector<std::vector<Vec3>> relax(std::span<const BranchLine> lines, const Holds& holds);

}  // namespace marrow
