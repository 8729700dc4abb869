#include <algorithm>
#include <charconv>
#include <vector>

#include "analytic_shapes.hpp"

namespace marrow {
namespace {

void append_number(std::string& out, double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  out.append(text, end);
}

void append_node(std::string& out, const CurveSkeleton::Node& node) {
  const Vec3& p = node.position;
  out += '[';
  for (const double value : {p.x, p.y, p.z, node.radius}) {
    if (out.back() != '[') out += ", ";
    append_number(out, value);
  }
  out += ']';
}

const char* kind_name(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Closed:
      return "closed";
    case SurfaceKind::Overlapping:
      return "union";
    case SurfaceKind::Flat:
      return "flat";
  }
  return "";
}

std::string counts_json(const AnalyticShape& shape) {
  std::string tips = "\"n/a\"";
  if (shape.leaves) {
    const std::string count = std::to_string(*shape.leaves);
    tips = "[" + count + ", " + count + "]";
  }
  const auto count = [](const char* name, int value) {
    return std::string("\"") + name + "\": " + std::to_string(value);
  };
  const CurveSkeleton& truth = shape.truth;
  return " \"expected\": {" + count("components", shape.components) + ", " +
         count("cycles", shape.cycles) + ", \"tips\": " + tips + "},\n \"graph_stats\": {" +
         count("components", component_count(truth)) + ", " + count("cycles", cycle_count(truth)) +
         ", " + count("tips", leaf_count(truth)) + ", " + count("junctions", joint_count(truth)) +
         "},\n";
}

void append_edge(std::string& out, const CurveSkeleton& truth, const Branch& branch,
                 const std::vector<NodeId>& ends) {
  const auto number = [&](NodeId node) {
    return std::to_string(std::lower_bound(ends.begin(), ends.end(), node) - ends.begin());
  };
  out += "{\"a\": " + number(branch.nodes.front()) + ", \"b\": " + number(branch.nodes.back()) +
         ", \"polyline_xyzr\": [";
  for (const NodeId node : branch.nodes) {
    if (out.back() != '[') out += ", ";
    append_node(out, truth.nodes[node]);
  }
  out += "]}";
}

}  // namespace

std::string format_truth_json(const AnalyticShape& shape) {
  const std::vector<Branch> lines = branches(shape.truth);
  std::vector<NodeId> ends;
  for (const Branch& branch : lines) {
    ends.push_back(branch.nodes.front());
    ends.push_back(branch.nodes.back());
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::string out = "{\"name\": \"" + shape.name + "\",\n \"kind\": \"" + kind_name(shape.surface) +
                    "\",\n \"note\": \"" + shape.note + "\",\n" + counts_json(shape) +
                    " \"nodes\": [";
  const char* separator = "\n  ";
  for (const NodeId node : ends) {
    out += separator;
    append_node(out, shape.truth.nodes[node]);
    separator = ",\n  ";
  }
  out += "],\n \"edges\": [";
  separator = "\n  ";
  for (const Branch& branch : lines) {
    out += separator;
    append_edge(out, shape.truth, branch, ends);
    separator = ",\n  ";
  }
  return out + "]}\n";
}

}  // namespace marrow
