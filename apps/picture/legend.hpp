// The strip below the views: colours of the radii, marks, counts.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <string>

#include "picture/image.hpp"

namespace marrow {

/// Balls that mark nodes.
inline constexpr Colour kJointColour = from_bytes(248, 250, 252);
inline constexpr Colour kLeafColour = from_bytes(24, 160, 120);
inline constexpr Colour kTextColour = from_bytes(60, 64, 74);
inline constexpr Colour kFaintTextColour = from_bytes(140, 146, 156);

/// What is written and ruled with on a background, light or dark, and what is far away.
struct Inks {
  Colour text, faint, rule, haze;
};
Inks inks_on(const Colour& background);

/// Least and greatest radius; 0, 0 without nodes.
struct RadiusRange {
  double least = 0, greatest = 0;

  /// Place of `radius` in the range, 0..1; the middle where all are the same.
  float place_of(double radius) const;
};
RadiusRange radius_range(const CurveSkeleton& skeleton);

/// Three figures.
std::string short_number(double value);

/// The counts that the legend names, each with its word: "3 joints".
struct LegendCounts {
  std::string nodes, joints, leaves, cycles, components;
};
LegendCounts legend_counts(const CurveSkeleton& skeleton);

/// Writes the legend into `area`; `dot` is the size of a dot of the font in pixels.
void draw_legend(Canvas& canvas, const Rect& area, const CurveSkeleton& skeleton, float dot,
                 const Colour& ink);

}  // namespace marrow
