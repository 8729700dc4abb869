// GraphML, as networkx, Gephi and yEd read it.
#include <marrow/error.hpp>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "skeleton_xml_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

/// What a node is read from, by the names of its keys.
constexpr std::array<std::string_view, 5> kProperties = {"x", "y", "z", "radius", "section_radius"};

/// An edge as it is named, before all nodes are known.
struct Link {
  std::string a, b;
  std::size_t line;
};

struct Contents {
  std::map<std::string, std::size_t, std::less<>> property_of_key;  ///< index into kProperties
  std::map<std::string, NodeId, std::less<>> ids;
  CurveSkeleton skeleton;
  std::vector<Link> links;
};

void append_key(std::string& text, const char* name, const char* element, const char* type) {
  text += std::string("  <key id=\"") + name + "\" for=\"" + element + "\" attr.name=\"" + name +
          "\" attr.type=\"" + type + "\"/>\n";
}

template <class Number>
void append_data(std::string& text, const char* key, Number value) {
  text += std::string("<data key=\"") + key + "\">";
  append(text, value);
  text += "</data>";
}

void append_node(std::string& text, const CurveSkeleton::Node& node, std::uint64_t id,
                 bool with_section) {
  text += "    <node id=\"";
  append(text, id);
  text += "\">";
  append_data(text, "x", node.position.x);
  append_data(text, "y", node.position.y);
  append_data(text, "z", node.position.z);
  append_data(text, "radius", node.radius);
  if (with_section) append_data(text, "section_radius", node.section_radius);
  text += "</node>\n";
}

void read_key(XmlReader& xml, Contents& contents) {
  const std::string* element = xml.attribute("for");
  const std::string* name = xml.attribute("attr.name");
  if (name != nullptr && (element == nullptr || *element == "node" || *element == "all"))
    for (std::size_t i = 0; i < kProperties.size(); ++i)
      if (kProperties[i] == *name) contents.property_of_key[xml.required("id")] = i;
  xml.skip_element();
}

using Properties = std::array<std::optional<double>, kProperties.size()>;

void read_data(XmlReader& xml, const Contents& contents, Properties& properties) {
  const auto key = contents.property_of_key.find(xml.required("key"));
  if (key == contents.property_of_key.end()) return xml.skip_element();
  const std::vector<double> numbers = xml.element_numbers<double>();
  if (numbers.size() != 1)
    xml.fail("the " + std::string(kProperties[key->second]) + " of a node is not one number");
  properties[key->second] = numbers[0];
}

CurveSkeleton::Node node_of(const XmlReader& xml, const std::string& id, const Properties& p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!p[i]) xml.fail("the node " + quoted(id) + " has no " + std::string(kProperties[i]));
  CurveSkeleton::Node node{{*p[0], *p[1], *p[2]}, p[3].value_or(0), p[4].value_or(0)};
  std::string fault = check_radius(node.radius, p[3].has_value(), xml.source());
  if (fault.empty()) fault = check_section_radius(node.section_radius, node.radius);
  if (!fault.empty()) xml.fail("the node " + quoted(id) + ": " + fault);
  return node;
}

void read_node(XmlReader& xml, Contents& contents) {
  const std::string id = xml.required("id");
  const auto number = static_cast<NodeId>(contents.skeleton.nodes.size());
  if (!contents.ids.try_emplace(id, number).second)
    xml.fail("the node " + quoted(id) + " is given twice");
  Properties properties;
  xml.for_each_child([&] {
    if (xml.name() == "graph") xml.fail("a graph within the node " + quoted(id));
    if (xml.name() == "data")
      read_data(xml, contents, properties);
    else
      xml.skip_element();
  });
  contents.skeleton.nodes.push_back(node_of(xml, id, properties));
}

void read_graph(XmlReader& xml, Contents& contents) {
  xml.for_each_child([&] {
    if (xml.name() == "node") return read_node(xml, contents);
    if (xml.name() == "hyperedge") xml.fail("a hyperedge; an edge joins two nodes");
    if (xml.name() == "edge")
      contents.links.push_back({xml.required("source"), xml.required("target"), xml.line()});
    xml.skip_element();
  });
}

void connect(Contents& contents, const std::string& name) {
  for (const Link& link : contents.links) {
    const auto node = [&](const std::string& id) {
      const auto found = contents.ids.find(id);
      if (found == contents.ids.end())
        fail(name, link.line, "the node " + quoted(id) + " is not in this file");
      return found->second;
    };
    const NodeId a = node(link.a), b = node(link.b);
    if (a == b) fail(name, link.line, "an edge from a node to itself");
    contents.skeleton.edges.push_back({a, b});
  }
}

}  // namespace

std::string format_graphml(const CurveSkeleton& skeleton) {
  const bool with_sections = has_section_radii(skeleton);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  for (const auto property : kProperties)
    if (property != "section_radius" || with_sections)
      append_key(text, std::string(property).c_str(), "node", "double");
  append_key(text, "length", "edge", "double");
  append_key(text, "branch", "edge", "int");
  text += "  <graph id=\"skeleton\" edgedefault=\"undirected\">\n";
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i)
    append_node(text, skeleton.nodes[i], i, with_sections);
  const auto branch_of = branch_of_edges(skeleton);
  for (std::size_t i = 0; i < skeleton.edges.size(); ++i) {
    const auto [a, b] = skeleton.edges[i];
    text += "    <edge source=\"" + std::to_string(a) + "\" target=\"" + std::to_string(b) + "\">";
    append_data(text, "length", distance(skeleton.nodes[a].position, skeleton.nodes[b].position));
    append_data(text, "branch", std::uint64_t{branch_of[i]});
    text += "</edge>\n";
  }
  return text + "  </graph>\n</graphml>\n";
}

CurveSkeleton parse_graphml(std::string_view bytes, const Source& source) {
  XmlReader xml(bytes, source);
  if (xml.next() != XmlReader::Event::Start || xml.name() != "graphml")
    xml.fail("the first element is not <graphml>");
  Contents contents;
  bool has_graph = false;
  xml.for_each_child([&] {
    if (xml.name() == "key") return read_key(xml, contents);
    if (xml.name() != "graph") return xml.skip_element();
    if (std::exchange(has_graph, true)) xml.fail("a second graph; write the file with one");
    read_graph(xml, contents);
  });
  xml.next();  // nothing follows
  if (!has_graph) xml.fail("no graph in the file");
  connect(contents, source.name);
  tidy_edges(contents.skeleton);
  return std::move(contents.skeleton);
}

}  // namespace marrow::skeleton_detail
