#include "viewer/view_page.hpp"

#include <marrow/surface_map.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstdio>

#include "picture/camera.hpp"
#include "picture/colour_map.hpp"
#include "viewer/base64.hpp"
#include "viewer/coarse_shape.hpp"
#include "viewer/page_parts.hpp"

namespace marrow {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kRadiusColours = 12;

/// Little-endian, whatever the machine.
template <class Numbers, class Bits>
Json array_of(const char* type, const Numbers& numbers, Bits bits) {
  std::string bytes;
  for (const auto number : numbers) {
    const auto value = bits(number);
    for (std::size_t i = 0; i < sizeof value; ++i)
      bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
  return {{"type", type}, {"data", base64(bytes)}};
}

Json array_of(const std::vector<std::uint16_t>& numbers) {
  return array_of("u16", numbers, [](std::uint16_t n) { return n; });
}
Json array_of(const std::vector<std::uint32_t>& numbers) {
  return array_of("u32", numbers, [](std::uint32_t n) { return n; });
}
Json array_of(const std::vector<float>& numbers) {
  return array_of("f32", numbers, [](float n) { return std::bit_cast<std::uint32_t>(n); });
}

std::vector<std::uint16_t> flat(const std::vector<std::array<std::uint16_t, 3>>& triples) {
  std::vector<std::uint16_t> numbers;
  numbers.reserve(3 * triples.size());
  for (const auto& triple : triples) numbers.insert(numbers.end(), triple.begin(), triple.end());
  return numbers;
}

std::string hex(const Colour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", to_byte(colour.r), to_byte(colour.g),
                to_byte(colour.b));
  return text;
}

Json describe_shape(const ViewContent& content, const Normalization& pose) {
  const Shape& shape = content.shape;
  std::vector<Vec3> places = shape.points;
  for (Vec3& p : places) p = place(pose, p);
  const CoarseShape coarse = coarsened(places, shape.triangles);
  std::vector<std::uint16_t> branch;
  if (!content.lines.empty() && !content.lines[0].skeleton.nodes.empty()) {
    const SurfaceMap map = map_surface(shape, content.lines[0].skeleton);
    for (const std::uint32_t source : coarse.source)
      branch.push_back(static_cast<std::uint16_t>(map.places[source].branch));
  }
  return {{"positions", array_of(flat(coarse.points))},
          {"triangles", array_of(flat(coarse.triangles))},
          {"branches", array_of(branch)}};
}

Json describe_lines(const ViewLines& lines, const Normalization& pose) {
  std::vector<float> positions, radii;
  for (const auto& node : lines.skeleton.nodes) {
    const Vec3 p = place(pose, node.position);
    for (const double c : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(c));
    const double radius = node.radius / pose.length_to_input(1);
    radii.push_back(static_cast<float>(std::min(radius, 1000.0)));
  }
  std::vector<std::uint32_t> edges;
  for (const auto& e : lines.skeleton.edges) edges.insert(edges.end(), e.begin(), e.end());
  return {{"name", lines.name},
          {"positions", array_of(positions)},
          {"radii", array_of(radii)},
          {"edges", array_of(edges)},
          {"branches", array_of(branch_of_edges(lines.skeleton))}};
}

Json describe_facts(const ViewContent& content) {
  Json facts = Json::array();
  const auto add = [&](const char* name, const auto& value) { facts.push_back({name, value}); };
  const Shape& shape = content.shape;
  add("points", std::to_string(shape.points.size()));
  if (!shape.triangles.empty()) add("triangles", std::to_string(shape.triangles.size()));
  if (content.lines.empty()) return facts;
  const CurveSkeleton& s = content.lines[0].skeleton;
  add("nodes", std::to_string(s.nodes.size()));
  add("branches", std::to_string(branches(s).size()));
  add("joints", std::to_string(joint_count(s)));
  add("tips", std::to_string(leaf_count(s)));
  add("cycles", std::to_string(cycle_count(s)));
  add("parts", std::to_string(component_count(s)));
  char length[32];
  std::snprintf(length, sizeof length, "%.4g", total_length(s));
  add("length", std::string(length));
  return facts;
}

Json describe(const ViewContent& content) {
  const CurveSkeleton none;
  const CurveSkeleton& skeleton = content.lines.empty() ? none : content.lines[0].skeleton;
  const Normalization pose = pose_of(content.shape, skeleton);
  Json data{{"format", "marrow-view"}, {"version", 1}, {"unit", pose.length_to_input(1)}};
  data["facts"] = describe_facts(content);
  data["palette"] = Json::array();
  const std::size_t colours = std::min<std::size_t>(branches(skeleton).size() + 1, 4096);
  for (std::uint32_t b = 0; b < colours; ++b) data["palette"].push_back(hex(branch_colour(b)));
  for (int i = 0; i < kRadiusColours; ++i)
    data["radiusColours"].push_back(
        hex(radius_colour(static_cast<float>(i) / (kRadiusColours - 1))));
  data["shape"] = describe_shape(content, pose);
  data["lines"] = Json::array();
  for (const ViewLines& lines : content.lines) data["lines"].push_back(describe_lines(lines, pose));
  return data;
}

/// JSON that cannot end the element of a page that it stands in.
std::string script_text(const Json& data) {
  const std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  return safe;
}

/// Words that HTML takes for nothing but words. Bytes that are not UTF-8 become the sign for that.
std::string html_text(const std::string& words) {
  const Json valid = Json::parse(Json(words).dump(-1, ' ', false, Json::error_handler_t::replace));
  std::string safe;
  for (const char c : valid.get<std::string>()) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return safe;
}

std::string part(const std::string& name, const ViewContent& content) {
  if (name == "TITLE") return html_text(content.title);
  if (name == "DATA") return script_text(describe(content));
  return name == "STYLE" ? kPageStyle : kPageScript;
}

}  // namespace

std::string view_page(const ViewContent& content) {
  const std::string page = kPage;
  std::string result;
  for (std::size_t at = 0;;) {
    const std::size_t mark = page.find('@', at), end = page.find('@', mark + 1);
    result.append(page, at, mark - at);
    if (mark == std::string::npos) return result;
    result += part(page.substr(mark + 1, end - mark - 1), content);
    at = end + 1;
  }
}

}  // namespace marrow
