// How far two curve-skeletons are apart.
#pragma once

#include <marrow/curve_skeleton.hpp>

namespace marrow {

/// How far the lines and lone nodes of one skeleton are from those of another, in units of the
/// shape.
struct LineDistance {
  double mean = 0;  ///< over the length of the lines; over the nodes where there are no lines
  double most = 0;  ///< one-sided Hausdorff distance
};

struct Comparison {
  LineDistance there;   ///< of the first skeleton from the second
  LineDistance back;    ///< of the second from the first
  double diagonal = 0;  ///< of the box around the first skeleton

  double mean() const { return (there.mean + back.mean) / 2; }
  double hausdorff() const { return there.most > back.most ? there.most : back.most; }
};

/// Lines are measured at points that are at most `step` times the diagonal of the box around both
/// skeletons apart; the distance from each to the nearest line is exact, so `most` is right to
/// within half of that. Radii do not count.
/// Throws Error: Empty (a skeleton without nodes), Usage (a step not in (0, 1]).
Comparison compare(const CurveSkeleton& first, const CurveSkeleton& second, double step = 0.001);

}  // namespace marrow
