// Our own format: versioned, one node per line, so that two files can be compared by `diff`.
#include <marrow/error.hpp>

#include <nlohmann/json.hpp>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

using nlohmann::json;

constexpr int kDeepest = 64;
constexpr std::uint64_t kVersion = 1, kVersionWithSections = 2;  ///< of the file

[[noreturn]] void fail_at(const std::string& name, const std::string& place,
                          const std::string& what) {
  throw Error(ErrorKind::Malformed, name + ": " + place + ": " + what);
}

json parse_text(std::string_view bytes, const std::string& name) {
  const auto shallow = [&](int depth, json::parse_event_t, json&) {
    if (depth > kDeepest)
      throw Error(ErrorKind::Malformed,
                  name + ": the JSON is nested more than " + std::to_string(kDeepest) + " deep");
    return true;
  };
  try {
    return json::parse(bytes, shallow);
  } catch (const json::exception& e) {
    // Its words begin with "[json.exception.parse_error.101] " and may quote bytes of the file.
    const std::string_view words = e.what();
    const std::size_t begin = words.find("] ");
    std::string text(words.substr(begin == std::string_view::npos ? 0 : begin + 2, 160));
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    throw Error(ErrorKind::Malformed, name + ": not JSON: " + text);
  }
}

std::uint64_t version_of(const json& file, const std::string& name) {
  const auto format = file.is_object() ? file.find("format") : file.end();
  if (!file.is_object() || format == file.end() || *format != "marrow-skeleton")
    throw Error(ErrorKind::Malformed, name + ": no \"format\": \"marrow-skeleton\" in this file");
  const auto version = file.find("version");
  if (version == file.end() || !version->is_number_unsigned())
    fail_at(name, "version", "is not a number");
  if (*version != kVersion && *version != kVersionWithSections)
    throw Error(ErrorKind::Unsupported,
                name + ": version " + version->dump() + "; this program reads versions 1 and 2");
  return version->get<std::uint64_t>();
}

const json& array_of(const json& file, const char* key, const std::string& name) {
  const auto found = file.find(key);
  if (found == file.end() || !found->is_array()) fail_at(name, key, "is not an array");
  return *found;
}

CurveSkeleton::Node node_of(const json& row, std::uint64_t version, const std::string& name,
                            std::size_t index) {
  const auto fail_here = [&](const std::string& what) {
    fail_at(name, "nodes[" + std::to_string(index) + "]", what);
  };
  const bool with_section = version == kVersionWithSections;
  if (!row.is_array() || row.size() != (with_section ? 5 : 4))
    fail_here(with_section ? "is not [x, y, z, radius, section_radius]"
                           : "is not [x, y, z, radius]");
  for (const json& value : row)
    if (!value.is_number()) fail_here("is not of numbers");
  CurveSkeleton::Node node{{row[0].get<double>(), row[1].get<double>(), row[2].get<double>()},
                           row[3].get<double>()};
  if (!(node.radius > 0)) fail_here("has a radius that is not greater than 0");
  if (with_section) node.section_radius = row[4].get<double>();
  const std::string fault = check_section_radius(node.section_radius, node.radius);
  if (!fault.empty()) fail_here(fault);
  return node;
}

CurveSkeleton::Edge edge_of(const json& row, std::size_t nodes, const std::string& name,
                            std::size_t index) {
  const auto fail_here = [&](const std::string& what) {
    fail_at(name, "edges[" + std::to_string(index) + "]", what);
  };
  if (!row.is_array() || row.size() != 2) fail_here("is not [i, j]");
  for (const json& value : row)
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= nodes)
      fail_here("has a node that is not an integer below " + std::to_string(nodes));
  if (row[0] == row[1]) fail_here("is an edge from a node to itself");
  return {row[0].get<NodeId>(), row[1].get<NodeId>()};
}

void append_count(std::string& text, const char* key, std::size_t count) {
  text += std::string("\"") + key + "\": ";
  append(text, std::uint64_t{count});
}

void append_counts(std::string& text, const CurveSkeleton& s) {
  const auto rest = [&](const char* key, int count) {
    text += ", ";
    append_count(text, key, static_cast<std::size_t>(count));
  };
  append_count(text, "nodes", s.nodes.size());
  text += ", ";
  append_count(text, "edges", s.edges.size());
  rest("components", component_count(s));
  rest("cycles", cycle_count(s));
  rest("leaves", leaf_count(s));
  rest("joints", joint_count(s));
}

/// `"key": [`, a line for every row, `]`.
template <typename Rows, typename AppendRow>
void append_rows(std::string& text, const char* key, const Rows& rows, AppendRow append_row) {
  text += std::string("  \"") + key + "\": [";
  const char* before = "\n    [";
  for (const auto& row : rows) {
    text += before;
    append_row(row);
    text += ']';
    before = ",\n    [";
  }
  text += rows.empty() ? "]" : "\n  ]";
}

}  // namespace

std::string format_json(const CurveSkeleton& skeleton) {
  const bool with_sections = has_section_radii(skeleton);
  std::string text = "{\n  \"format\": \"marrow-skeleton\",\n  \"version\": ";
  append(text, with_sections ? kVersionWithSections : kVersion);
  text += ",\n  \"units\": \"of the shape\",\n  \"counts\": {";
  append_counts(text, skeleton);
  text += "},\n";
  append_rows(text, "nodes", skeleton.nodes, [&](const auto& node) {
    append(text, node, ", ");
    if (!with_sections) return;
    text += ", ";
    append(text, node.section_radius);
  });
  text += ",\n";
  append_rows(text, "edges", skeleton.edges, [&](const auto& edge) {
    append(text, std::uint64_t{edge[0]});
    text += ", ";
    append(text, std::uint64_t{edge[1]});
  });
  return text + "\n}\n";
}

CurveSkeleton parse_json(std::string_view bytes, const Source& source) {
  const std::string& name = source.name;
  const json file = parse_text(bytes, name);
  const std::uint64_t version = version_of(file, name);
  CurveSkeleton skeleton;
  for (const json& row : array_of(file, "nodes", name))
    skeleton.nodes.push_back(node_of(row, version, name, skeleton.nodes.size()));
  std::size_t index = 0;
  for (const json& row : array_of(file, "edges", name))
    skeleton.edges.push_back(edge_of(row, skeleton.nodes.size(), name, index++));
  tidy_edges(skeleton);
  return skeleton;
}

}  // namespace marrow::skeleton_detail
