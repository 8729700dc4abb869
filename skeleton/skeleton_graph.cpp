// The .graph files of GEL: nodes `n x y z radius`, connections `c i j` from 0.
#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

void read_node(const Lines& lines, CurveSkeleton& skeleton) {
  if (lines.words().size() != 4 && lines.words().size() != 5)
    lines.fail("a node is 'n x y z radius'; this line has " +
               std::to_string(lines.words().size() - 1) + " numbers");
  skeleton.nodes.push_back({{lines.number(1), lines.number(2), lines.number(3)}, lines.radius(4)});
}

void read_connection(const Lines& lines, CurveSkeleton& skeleton) {
  if (lines.words().size() != 3) lines.fail("a connection is 'c i j'");
  const std::uint64_t a = lines.count(1), b = lines.count(2), count = skeleton.nodes.size();
  if (a >= count || b >= count)
    lines.fail("node index " + std::to_string(std::max(a, b)) + " is not below " +
               std::to_string(count) + ", the number of nodes so far");
  lines.check_edge(static_cast<NodeId>(a), static_cast<NodeId>(b));
  skeleton.edges.push_back({static_cast<NodeId>(a), static_cast<NodeId>(b)});
}

}  // namespace

std::string format_graph(const CurveSkeleton& skeleton) {
  std::string text;
  for (const auto& node : skeleton.nodes) {
    text += "n ";
    append(text, node, " ");
    text += '\n';
  }
  for (const auto& e : skeleton.edges) {
    text += "c ";
    append(text, std::uint64_t{e[0]});
    text += ' ';
    append(text, std::uint64_t{e[1]});
    text += '\n';
  }
  return text;
}

CurveSkeleton parse_graph(std::string_view bytes, const Source& source) {
  CurveSkeleton skeleton;
  for (Lines lines(bytes, source); lines.next();) {
    const std::string_view key = lines.words()[0];
    if (key == "n")
      read_node(lines, skeleton);
    else if (key == "c")
      read_connection(lines, skeleton);
    else if (key[0] != '#')
      lines.fail(quoted(key) + " is not a line of a .graph file; 'n' and 'c' are");
  }
  tidy_edges(skeleton);
  return skeleton;
}

}  // namespace marrow::skeleton_detail
