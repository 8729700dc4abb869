// DOT, for pictures of the graph by Graphviz; only written.
#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

void append_attribute(std::string& text, const char* name, double value) {
  text += name;
  text += "=\"";
  append(text, value);
  text += '"';
}

}  // namespace

std::string format_dot(const CurveSkeleton& skeleton) {
  const bool with_sections = has_section_radii(skeleton);
  std::string text = "graph skeleton {\n  node [shape=point];\n";
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    const auto& node = skeleton.nodes[i];
    text += "  ";
    append(text, std::uint64_t{i});
    append_attribute(text, " [x", node.position.x);
    append_attribute(text, ", y", node.position.y);
    append_attribute(text, ", z", node.position.z);
    append_attribute(text, ", radius", node.radius);
    if (with_sections) append_attribute(text, ", section_radius", node.section_radius);
    text += "];\n";
  }
  for (const auto& [a, b] : skeleton.edges) {
    text += "  ";
    append(text, std::uint64_t{a});
    text += " -- ";
    append(text, std::uint64_t{b});
    append_attribute(text, " [length",
                     distance(skeleton.nodes[a].position, skeleton.nodes[b].position));
    text += "];\n";
  }
  return text + "}\n";
}

}  // namespace marrow::skeleton_detail
