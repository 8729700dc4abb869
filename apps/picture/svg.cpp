// The picture as lines: for print, and for drawing programs.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "picture/colour_map.hpp"
#include "picture/legend.hpp"
#include "picture/render.hpp"
#include "picture/scene.hpp"

namespace marrow {
namespace {

constexpr Colour kBody = from_bytes(214, 226, 236);
constexpr Colour kOutline = from_bytes(28, 26, 40);

/// To a hundredth of a pixel, without zeros at the end.
std::string number(double value) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), std::floor(value * 100 + 0.5) / 100);
  return {text.data(), end.ptr};
}

std::string hex(const Colour& colour) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const float channel : {colour.r, colour.g, colour.b}) {
    const unsigned byte = to_byte(channel);
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  return text;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string line(const Vec3& a, const Vec3& b, double width, const Colour& colour) {
  return "<line" + attribute("x1", number(a.x)) + attribute("y1", number(a.y)) +
         attribute("x2", number(b.x)) + attribute("y2", number(b.y)) +
         attribute("stroke", hex(colour)) + attribute("stroke-width", number(width)) + "/>\n";
}

std::string circle(const Vec3& at, double radius, const Colour& colour, double outline) {
  std::string text = "<circle" + attribute("cx", number(at.x)) + attribute("cy", number(at.y)) +
                     attribute("r", number(radius)) + attribute("fill", hex(colour));
  if (outline > 0)
    text += attribute("stroke", hex(kOutline)) + attribute("stroke-width", number(outline));
  return text + "/>\n";
}

std::string words(double x, double y, double size, const Colour& ink, const std::string& text) {
  return "<text" + attribute("x", number(x)) + attribute("y", number(y)) +
         attribute("font-size", number(size)) + attribute("fill", hex(ink)) + ">" + text +
         "</text>\n";
}

/// The part of the pale body that an edge or a node stands for: a line as wide as its ball.
std::string body_of(const CurveSkeleton& skeleton, const Scene& scene, const View& view) {
  const double pixels = view.scale / scene.pose.length_to_input(1);
  std::string text;
  const auto place_of = [&](NodeId n) {
    return view.project(place(scene.pose, skeleton.nodes[n].position));
  };
  for (const auto& [a, b] : skeleton.edges)
    text += line(place_of(a), place_of(b),
                 pixels * (skeleton.nodes[a].radius + skeleton.nodes[b].radius), kBody);
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] != 2) text += circle(place_of(n), pixels * skeleton.nodes[n].radius, kBody, 0);
  return text;
}

Colour hazy(const Colour& colour, const Stroke& stroke, const Colour& haze) {
  return mix(colour, haze, 0.5F * (stroke.haze_a + stroke.haze_b));
}

/// Twice the nearness; a ball stands out in front of the tubes that end in it.
double nearness(const Stroke& stroke) {
  const double out = stroke.a == stroke.b ? 4 * static_cast<double>(stroke.radius) : 0;
  return stroke.a.z + stroke.b.z + out;
}

/// From the farthest to the nearest.
std::string strokes_in_order(std::vector<Stroke> strokes, const Colour& haze) {
  std::stable_sort(strokes.begin(), strokes.end(),
                   [](const Stroke& a, const Stroke& b) { return nearness(a) < nearness(b); });
  std::string text;
  for (const Stroke& stroke : strokes) {
    const Colour colour =
        stroke.is_marked ? stroke.colour : radius_colour(0.5F * (stroke.value_a + stroke.value_b));
    const auto radius = static_cast<double>(stroke.radius);
    if (stroke.a == stroke.b)
      text +=
          circle(stroke.a, radius, hazy(colour, stroke, haze), static_cast<double>(stroke.outline));
    else
      text += line(stroke.a, stroke.b, 2 * radius, hazy(colour, stroke, haze));
  }
  return text;
}

/// A bar of the colours of radii between the least and the greatest.
std::string radius_bar(const RadiusRange& range, double x, double y, double dot) {
  constexpr int kSteps = 20;
  std::string text;
  for (int i = 0; i < kSteps; ++i) {
    const float from = range.place_of(range.least), to = range.place_of(range.greatest);
    const Colour colour =
        radius_colour(from + (to - from) * (static_cast<float>(i) + 0.5F) / kSteps);
    const double left = x + 80 * dot * i / kSteps, right = x + 80 * dot * (i + 1) / kSteps;
    text += "<rect" + attribute("x", number(left)) + attribute("y", number(y - 7 * dot)) +
            attribute("width", number(right - left)) + attribute("height", number(7 * dot)) +
            attribute("fill", hex(colour)) + "/>\n";
  }
  return text;
}

std::string legend_of(const CurveSkeleton& skeleton, const Scene& scene, const Inks& inks) {
  const auto dot = static_cast<double>(scene.sizes.dot);
  const double size = 9 * dot, y = scene.legend.top + 0.5 * scene.legend.height + 3.5 * dot;
  const LegendCounts counts = legend_counts(skeleton);
  std::string text;
  double x = 8 * dot;
  if (!skeleton.nodes.empty()) {
    const RadiusRange range = radius_range(skeleton);
    text += words(x, y, size, inks.text, "radius " + short_number(range.least));
    text += radius_bar(range, x + 72 * dot, y, dot);
    text += words(x + 156 * dot, y, size, inks.text, short_number(range.greatest));
    x += 210 * dot;
  }
  return text + words(x, y, size, inks.text,
                      counts.nodes + ", " + counts.joints + ", " + counts.leaves + ", " +
                          counts.cycles + ", " + counts.components);
}

}  // namespace

std::string render_svg(const Shape& shape, const CurveSkeleton& skeleton,
                       const RenderOptions& options) {
  const Scene scene = scene_of(shape, skeleton, options);
  const Inks inks = inks_on(options.background);
  const std::string width = std::to_string(options.width), height = std::to_string(options.height);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
      attribute("height", height) + attribute("viewBox", "0 0 " + width + " " + height) +
      " stroke-linecap=\"round\" font-family=\"sans-serif\">\n<rect" + attribute("width", width) +
      attribute("height", height) + attribute("fill", hex(options.background)) + "/>\n";
  const auto dot = static_cast<double>(scene.sizes.dot);
  for (const View& view : scene.views) {
    svg += "<g" + attribute("id", std::string(view.name)) + ">\n";
    svg += body_of(skeleton, scene, view);
    svg += strokes_in_order(strokes_of(skeleton, scene, view), inks.haze);
    if (options.legend)
      svg += words(view.cell.left + 8 * dot, view.cell.top + 16 * dot, 9 * dot, inks.faint,
                   std::string(view.name));
    svg += "</g>\n";
  }
  if (options.legend) svg += legend_of(skeleton, scene, inks);
  return svg + "</svg>\n";
}

}  // namespace marrow
