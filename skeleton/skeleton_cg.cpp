// The .cg files of starlab and of others after it. They have no radii: ours follow the edges as
// comments, where the readers of others, which stop there or pass over comments, do not see them.
#include <algorithm>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

struct Header {
  std::uint64_t nodes = 0, edges = 0;
};

/// An edge as the file has it: its indices may count from 0 or from 1.
struct Row {
  std::uint64_t a, b;
  std::size_t line;
};

/// The number behind `key` in a word of the header.
std::uint64_t header_number(const Lines& lines, std::size_t word, std::string_view key) {
  std::uint64_t value = 0;
  if (word >= lines.words().size() || !lines.words()[word].starts_with(key) ||
      !read_number(lines.words()[word].substr(key.size()), value))
    lines.fail("the first line is not '# D:3 NV:nodes NE:edges'");
  return value;
}

Header read_header(Lines& lines) {
  lines.expect("the line '# D:3 NV:nodes NE:edges'");
  if (lines.words()[0] != "#" || header_number(lines, 1, "D:") != 3)
    lines.fail("the first line is not '# D:3 NV:nodes NE:edges'");
  return {header_number(lines, 2, "NV:"), header_number(lines, 3, "NE:")};
}

/// `# radius i r`, from 1.
void read_radius(const Lines& lines, CurveSkeleton& skeleton) {
  const std::uint64_t index = lines.count(2);
  if (index < 1 || index > skeleton.nodes.size())
    lines.fail("vertex index " + std::to_string(index) + " is out of range 1.." +
               std::to_string(skeleton.nodes.size()));
  if (lines.words().size() != 4) lines.fail("a radius is '# radius i r'");
  skeleton.nodes[index - 1].radius = lines.radius(3);
}

void read_vertex(const Lines& lines, CurveSkeleton& skeleton) {
  if (lines.words().size() != 4 && lines.words().size() != 5)
    lines.fail("a node is 'v x y z'; this line has " + std::to_string(lines.words().size() - 1) +
               " numbers");
  const double radius = lines.words().size() == 5 ? lines.radius(4) : 0;
  skeleton.nodes.push_back({{lines.number(1), lines.number(2), lines.number(3)}, radius});
}

/// The first index of the file: 0 where an edge says so, else 1.
std::uint64_t first_index(const std::vector<Row>& rows) {
  const auto is_zero = [](const Row& row) { return row.a == 0 || row.b == 0; };
  return std::any_of(rows.begin(), rows.end(), is_zero) ? 0 : 1;
}

void connect(const std::vector<Row>& rows, const std::string& name, CurveSkeleton& skeleton) {
  const std::uint64_t first = first_index(rows), last = first + skeleton.nodes.size();
  for (const Row& row : rows) {
    if (row.a >= last || row.b >= last)
      fail(name, row.line,
           "vertex index " + std::to_string(std::max(row.a, row.b)) + " is out of range " +
               std::to_string(first) + ".." + std::to_string(last - 1) +
               (first == 0 ? "; another line has the index 0" : ""));
    if (row.a == row.b) fail(name, row.line, "an edge from a node to itself");
    skeleton.edges.push_back(
        {static_cast<NodeId>(row.a - first), static_cast<NodeId>(row.b - first)});
  }
}

}  // namespace

std::string format_cg(const CurveSkeleton& skeleton) {
  std::string text = "# D:3 NV:";
  append(text, std::uint64_t{skeleton.nodes.size()});
  text += " NE:";
  append(text, std::uint64_t{skeleton.edges.size()});
  text += '\n';
  for (const auto& node : skeleton.nodes) {
    text += 'v';
    for (const double value : {node.position.x, node.position.y, node.position.z}) {
      text += ' ';
      append(text, value);
    }
    text += '\n';
  }
  for (const auto& e : skeleton.edges) {
    text += "e ";
    append(text, std::uint64_t{e[0]} + 1);
    text += ' ';
    append(text, std::uint64_t{e[1]} + 1);
    text += '\n';
  }
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    text += "# radius ";
    append(text, std::uint64_t{i} + 1);
    text += ' ';
    append(text, skeleton.nodes[i].radius);
    text += '\n';
  }
  return text;
}

CurveSkeleton parse_cg(std::string_view bytes, const Source& source) {
  Lines lines(bytes, source);
  const Header header = read_header(lines);
  CurveSkeleton skeleton;
  std::vector<Row> rows;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v")
      read_vertex(lines, skeleton);
    else if (words[0] == "e" && words.size() == 3)
      rows.push_back({lines.count(1), lines.count(2), lines.line()});
    else if (words[0] == "#" && words.size() > 1 && words[1] == "radius")
      read_radius(lines, skeleton);
    else if (words[0][0] != '#')
      lines.fail(quoted(words[0]) + " is not a line of a .cg file; 'v x y z' and 'e i j' are");
  }
  if (skeleton.nodes.size() != header.nodes || rows.size() != header.edges)
    lines.fail("the first line claims " + std::to_string(header.nodes) + " nodes and " +
               std::to_string(header.edges) + " edges, the file has " +
               std::to_string(skeleton.nodes.size()) + " and " + std::to_string(rows.size()));
  for (auto& node : skeleton.nodes) {
    const std::string fault = check_radius(node.radius, node.radius > 0, source);
    if (!fault.empty()) lines.fail(fault);
  }
  connect(rows, source.name, skeleton);
  tidy_edges(skeleton);
  return skeleton;
}

}  // namespace marrow::skeleton_detail
