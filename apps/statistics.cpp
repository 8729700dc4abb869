#include "statistics.hpp"

#include <marrow/bounds.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/volume_summary.hpp>

#include <algorithm>
#include <cstdio>

namespace marrow {

namespace {

void add_bounds(Statistics& s, const Bounds& bounds) {
  if (bounds.is_empty) return;
  s["bounds"] = {{bounds.low.x, bounds.low.y, bounds.low.z},
                 {bounds.high.x, bounds.high.y, bounds.high.z}};
  s["diagonal"] = bounds.diagonal();
}

void add_radii(Statistics& s, const CurveSkeleton& skeleton) {
  if (skeleton.nodes.empty()) return;
  const auto thinner = [](const auto& a, const auto& b) { return a.radius < b.radius; };
  const auto [least, most] =
      std::minmax_element(skeleton.nodes.begin(), skeleton.nodes.end(), thinner);
  s["radius"] = {least->radius, most->radius};
  Bounds sections;
  for (const auto& node : skeleton.nodes)
    if (node.section_radius > 0) sections.add({node.section_radius, 0, 0});
  if (!sections.is_empty) s["section_radius"] = {sections.low.x, sections.high.x};
}

std::string text_of(const Statistics& value) {
  if (value.is_null()) return "n/a";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.6g", value.get<double>());
    return digits;
  }
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  // Pairs are a range; three numbers are a point.
  const char* between = value.size() == 2 ? " to " : " ";
  std::string text;
  for (const Statistics& item : value) {
    if (!text.empty()) text += between;
    text += text_of(item);
  }
  return text;
}

}  // namespace

Statistics statistics_of(const Shape& shape) {
  const ShapeSummary summary = summarize(shape);
  Statistics s;
  s["kind"] = shape.triangles.empty() ? "points" : "shape";
  s["points"] = summary.points;
  s["triangles"] = summary.triangles;
  if (!shape.triangles.empty()) {
    s["unused_points"] = summary.unused_points;
    s["flat_triangles"] = summary.flat_triangles;
    s["components"] = summary.components;
    s["closed"] = summary.is_closed();
    s["open_edges"] = summary.open_edges;
    s["crowded_edges"] = summary.crowded_edges;
    if (summary.handles) s["handles"] = *summary.handles;
  }
  add_bounds(s, summary.bounds);
  return s;
}

Statistics statistics_of(const Volume& volume) {
  Statistics s;
  s["kind"] = "volume";
  s["voxels"] = {volume.nx, volume.ny, volume.nz};
  s["spacing"] = {length(volume.steps[0]), length(volume.steps[1]), length(volume.steps[2])};
  s["foreground"] = foreground_count(volume);
  if (const auto topology = topology_of(volume)) {
    s["components"] = topology->components;
    s["cavities"] = topology->cavities;
    s["tunnels"] = topology->tunnels;
  }
  add_bounds(s, foreground_bounds(volume));
  return s;
}

Statistics statistics_of(const CurveSkeleton& skeleton) {
  Statistics s;
  s["kind"] = "skeleton";
  s["nodes"] = skeleton.nodes.size();
  s["edges"] = skeleton.edges.size();
  s["components"] = component_count(skeleton);
  s["cycles"] = cycle_count(skeleton);
  s["leaves"] = leaf_count(skeleton);
  s["joints"] = joint_count(skeleton);
  s["branches"] = branches(skeleton).size();
  s["length"] = total_length(skeleton);
  add_radii(s, skeleton);
  Bounds bounds;
  for (const auto& node : skeleton.nodes) bounds.add(node.position);
  add_bounds(s, bounds);
  return s;
}

std::string to_json(const Statistics& statistics) {
  return statistics.dump(2, ' ', false, Statistics::error_handler_t::replace) + "\n";
}

std::string to_table(const Statistics& statistics) {
  constexpr std::size_t kColumn = 16;
  std::string table;
  for (const auto& [key, value] : statistics.items()) {
    std::string line = key;
    std::replace(line.begin(), line.end(), '_', ' ');
    line.resize(std::max(kColumn, line.size() + 1), ' ');
    table += line + text_of(value) + "\n";
  }
  return table;
}

}  // namespace marrow
