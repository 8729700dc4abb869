// Ascii PLY with an element `edge`, as MeshLab and ParaView know it.
#include <marrow/error.hpp>

#include <algorithm>
#include <array>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<std::string> properties;
};

constexpr std::array<std::string_view, 16> kScalarTypes = {
    "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

void read_format(Lines& lines, const std::string& name) {
  lines.expect("the line 'ply'");
  if (lines.words().size() != 1 || lines.words()[0] != "ply")
    lines.fail("the first line is not 'ply'");
  lines.expect("the line 'format'");
  const auto& words = lines.words();
  if (words.size() != 3 || words[0] != "format") lines.fail("the second line is not a format");
  if (words[1] != "ascii")
    throw Error(ErrorKind::Unsupported,
                name + ":2: a curve-skeleton in " + quoted(words[1]) + "; write it as ascii");
}

void read_property(const Lines& lines, std::vector<Element>& elements) {
  const auto& words = lines.words();
  if (elements.empty()) lines.fail("a property before the first element");
  if (words.size() > 1 && words[1] == "list") {
    if (elements.back().name == "vertex" || elements.back().name == "edge")
      lines.fail("a list in the element '" + elements.back().name + "' of a curve-skeleton");
    return;
  }
  if (words.size() != 3) lines.fail("a property is 'property type name'");
  bool known = false;
  for (const auto type : kScalarTypes) known = known || type == words[1];
  if (!known) lines.fail(quoted(words[1]) + " is not a type of PLY");
  elements.back().properties.emplace_back(words[2]);
}

std::vector<Element> read_header(Lines& lines, const std::string& name) {
  read_format(lines, name);
  std::vector<Element> elements;
  for (;;) {
    lines.expect("'end_header'");
    const auto& words = lines.words();
    if (words[0] == "end_header") return elements;
    if (words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "property") {
      read_property(lines, elements);
    } else if (words[0] == "element" && words.size() == 3) {
      elements.push_back({std::string(words[1]), lines.count(2), {}});
    } else {
      lines.fail(quoted(words[0]) + " is not a line of a PLY header");
    }
  }
}

/// The place of the property in a row; behind the last one if there is none.
std::size_t find_column(const Element& element, std::string_view property) {
  const auto& all = element.properties;
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), property) - all.begin());
}

std::size_t column(const Lines& lines, const Element& element, std::string_view property) {
  const std::size_t found = find_column(element, property);
  if (found < element.properties.size()) return found;
  lines.fail("the element '" + element.name + "' has no property '" + std::string(property) + "'");
}

/// Calls `row` for every line of the element.
template <typename Row>
void for_each_row(Lines& lines, const Element& element, Row row) {
  // A row is one byte and an end of line at least; the last end of line may be missing.
  if (element.count > lines.bytes_left() / 2 + 1)
    lines.fail("the file claims " + std::to_string(element.count) + " rows of '" + element.name +
               "' and is too short for them");
  for (std::uint64_t i = 0; i < element.count; ++i) {
    lines.expect(element.name + " " + std::to_string(i + 1) + " of " +
                 std::to_string(element.count));
    row();
  }
}

void check_width(const Lines& lines, const Element& element) {
  if (lines.words().size() != element.properties.size())
    lines.fail("a row of '" + element.name + "' has " + std::to_string(lines.words().size()) +
               " numbers, the header says " + std::to_string(element.properties.size()));
}

void read_vertices(Lines& lines, const Element& element, CurveSkeleton& skeleton) {
  const std::size_t x = column(lines, element, "x"), y = column(lines, element, "y"),
                    z = column(lines, element, "z"), radius = find_column(element, "radius"),
                    section = find_column(element, "section_radius");
  for_each_row(lines, element, [&] {
    check_width(lines, element);
    CurveSkeleton::Node node{{lines.number(x), lines.number(y), lines.number(z)},
                             lines.radius(radius)};
    if (section < lines.words().size())
      node.section_radius = lines.section_radius(section, node.radius);
    skeleton.nodes.push_back(node);
  });
}

void read_edges(Lines& lines, const Element& element, std::uint64_t nodes,
                CurveSkeleton& skeleton) {
  const std::size_t first = column(lines, element, "vertex1"),
                    second = column(lines, element, "vertex2");
  const auto node = [&](std::size_t word) {
    const std::uint64_t index = lines.count(word);
    if (index >= nodes)
      lines.fail("vertex index " + std::to_string(index) + " is not below " +
                 std::to_string(nodes));
    return static_cast<NodeId>(index);
  };
  for_each_row(lines, element, [&] {
    check_width(lines, element);
    const NodeId a = node(first), b = node(second);
    lines.check_edge(a, b);
    skeleton.edges.push_back({a, b});
  });
}

}  // namespace

std::string format_ply(const CurveSkeleton& skeleton) {
  std::string text = "ply\nformat ascii 1.0\ncomment marrow curve-skeleton\nelement vertex ";
  append(text, std::uint64_t{skeleton.nodes.size()});
  text += "\nproperty double x\nproperty double y\nproperty double z\nproperty double radius\n";
  const bool with_sections = has_section_radii(skeleton);
  if (with_sections) text += "property double section_radius\n";
  text += "element edge ";
  append(text, std::uint64_t{skeleton.edges.size()});
  text += "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  for (const auto& node : skeleton.nodes) {
    append(text, node, " ");
    if (with_sections) {
      text += ' ';
      append(text, node.section_radius);
    }
    text += '\n';
  }
  for (const auto& e : skeleton.edges) {
    append(text, std::uint64_t{e[0]});
    text += ' ';
    append(text, std::uint64_t{e[1]});
    text += '\n';
  }
  return text;
}

CurveSkeleton parse_ply(std::string_view bytes, const Source& source) {
  Lines lines(bytes, source);
  const std::vector<Element> elements = read_header(lines, source.name);
  std::uint64_t nodes = 0;
  for (const Element& e : elements)
    if (e.name == "vertex") nodes += e.count;
  CurveSkeleton skeleton;
  for (const Element& e : elements) {
    if (e.name == "vertex")
      read_vertices(lines, e, skeleton);
    else if (e.name == "edge")
      read_edges(lines, e, nodes, skeleton);
    else
      for_each_row(lines, e, [] {});
  }
  if (lines.next()) lines.fail("the file goes on after its last element");
  tidy_edges(skeleton);
  return skeleton;
}

}  // namespace marrow::skeleton_detail
