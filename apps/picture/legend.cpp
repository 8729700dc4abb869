#include "picture/legend.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "picture/colour_map.hpp"
#include "picture/font.hpp"
#include "picture/strokes.hpp"

namespace marrow {
namespace {

/// Writes from left to right along one line.
class Line {
 public:
  Line(Canvas& canvas, const Rect& area, float dot)
      : canvas_(canvas),
        dot_(dot),
        x_(static_cast<float>(area.left)),
        middle_(static_cast<float>(area.top) + 0.5F * static_cast<float>(area.height)) {}

  void skip(float dots) { x_ += dots * dot_; }

  void write(const std::string& text, const Colour& colour) {
    draw_text(canvas_, x_, middle_ - 3.5F * dot_, text, dot_, colour);
    x_ += text_width(text, dot_);
  }

  /// The colours from one place of the map to another.
  void bar(float from, float to, float dots) {
    const int left = static_cast<int>(x_);
    const int right = static_cast<int>(x_ + dots * dot_);
    for (int y = static_cast<int>(middle_ - 3.5F * dot_);
         y < static_cast<int>(middle_ + 3.5F * dot_); ++y) {
      for (int x = left; x < right; ++x) {
        const float place = static_cast<float>(x - left) / static_cast<float>(right - left);
        canvas_.blend(x, y, radius_colour(from + place * (to - from)), 1);
      }
    }
    x_ += dots * dot_;
  }

  void ball(const Colour& colour) {
    const float radius = 3.0F * dot_;
    Stroke stroke;
    stroke.a = stroke.b = {static_cast<double>(x_ + radius), static_cast<double>(middle_), 0};
    stroke.radius = radius;
    stroke.outline = 0.5F * dot_;
    stroke.is_marked = true;
    stroke.colour = colour;
    draw_strokes(canvas_, canvas_.bounds(), {stroke});
    x_ += 2 * radius;
  }

 private:
  Canvas& canvas_;
  float dot_, x_, middle_;
};

std::string counted(int count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void write_radii(Line& line, const RadiusRange& range, const Colour& ink) {
  const std::string least = short_number(range.least);
  const std::string greatest = short_number(range.greatest);
  line.write("radius  " + least, ink);
  line.skip(5);
  line.bar(range.place_of(range.least), range.place_of(range.greatest),
           least == greatest ? 20 : 80);
  if (least != greatest) {
    line.skip(5);
    line.write(greatest, ink);
  }
  line.skip(24);
}

}  // namespace

Inks inks_on(const Colour& background) {
  const float lightness = 0.2126F * background.r + 0.7152F * background.g + 0.0722F * background.b;
  if (lightness >= 0.5F)
    return {kTextColour, kFaintTextColour, from_bytes(226, 229, 234), kPaleHaze};
  return {from_bytes(222, 226, 232), from_bytes(150, 156, 166), from_bytes(70, 74, 82), background};
}

std::string short_number(double value) {
  std::array<char, 40> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3);
  return {text.data(), end.ptr};
}

float RadiusRange::place_of(double radius) const {
  if (!(greatest > least)) return 0.5F;
  return static_cast<float>((radius - least) / (greatest - least));
}

RadiusRange radius_range(const CurveSkeleton& skeleton) {
  if (skeleton.nodes.empty()) return {};
  const auto [least, greatest] =
      std::minmax_element(skeleton.nodes.begin(), skeleton.nodes.end(),
                          [](const auto& a, const auto& b) { return a.radius < b.radius; });
  return {least->radius, greatest->radius};
}

LegendCounts legend_counts(const CurveSkeleton& skeleton) {
  return {counted(static_cast<int>(skeleton.nodes.size()), "node", "nodes"),
          counted(joint_count(skeleton), "joint", "joints"),
          counted(leaf_count(skeleton), "leaf", "leaves"),
          counted(cycle_count(skeleton), "cycle", "cycles"),
          counted(component_count(skeleton), "component", "components")};
}

void draw_legend(Canvas& canvas, const Rect& area, const CurveSkeleton& skeleton, float dot,
                 const Colour& ink) {
  const LegendCounts counts = legend_counts(skeleton);
  Line line(canvas, area, dot);
  line.skip(8);
  if (!skeleton.nodes.empty()) write_radii(line, radius_range(skeleton), ink);
  line.write(counts.nodes, ink);
  line.skip(18);
  line.ball(kJointColour);
  line.skip(4);
  line.write(counts.joints, ink);
  line.skip(18);
  line.ball(kLeafColour);
  line.skip(4);
  line.write(counts.leaves, ink);
  line.skip(18);
  line.write(counts.cycles, ink);
  line.skip(18);
  line.write(counts.components, ink);
}

}  // namespace marrow
