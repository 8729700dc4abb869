// OBJ with a fourth number per vertex, which viewers take for a weight and do not use.
#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

NodeId node_of(const Lines& lines, std::size_t word, std::size_t nodes) {
  const std::int64_t index = lines.integer(word);
  const auto count = static_cast<std::int64_t>(nodes);
  if (index == 0 || index > count || index < -count)
    lines.fail("vertex index " + std::to_string(index) + " is out of range 1.." +
               std::to_string(count));
  return static_cast<NodeId>(index > 0 ? index - 1 : count + index);
}

void read_vertex(const Lines& lines, CurveSkeleton& skeleton) {
  // With four words it is the file of others, who give no radius.
  if (lines.words().size() != 4 && lines.words().size() != 5)
    lines.fail("a node is 'v x y z radius'; this line has " +
               std::to_string(lines.words().size() - 1) + " numbers");
  skeleton.nodes.push_back({{lines.number(1), lines.number(2), lines.number(3)}, lines.radius(4)});
}

void read_line(const Lines& lines, CurveSkeleton& skeleton) {
  if (lines.words().size() < 3) lines.fail("a line needs two vertices or more: 'l i j'");
  NodeId last = node_of(lines, 1, skeleton.nodes.size());
  for (std::size_t i = 2; i < lines.words().size(); ++i) {
    const NodeId node = node_of(lines, i, skeleton.nodes.size());
    lines.check_edge(last, node);
    skeleton.edges.push_back({last, node});
    last = node;
  }
}

}  // namespace

std::string format_obj(const CurveSkeleton& skeleton) {
  std::string text = "# marrow curve-skeleton: v x y z radius, l i j\n";
  for (const auto& node : skeleton.nodes) {
    text += "v ";
    append(text, node, " ");
    text += '\n';
  }
  for (const auto& e : skeleton.edges) {
    text += "l ";
    append(text, std::uint64_t{e[0]} + 1);
    text += ' ';
    append(text, std::uint64_t{e[1]} + 1);
    text += '\n';
  }
  return text;
}

CurveSkeleton parse_obj(std::string_view bytes, const Source& source) {
  CurveSkeleton skeleton;
  for (Lines lines(bytes, source); lines.next();) {
    const std::string_view key = lines.words()[0];
    if (key[0] == '#' || key == "o" || key == "g" || key == "s") continue;
    if (key == "v")
      read_vertex(lines, skeleton);
    else if (key == "l")
      read_line(lines, skeleton);
    else if (key == "f")
      lines.fail("a face: this is a shape, not a curve-skeleton");
    else
      lines.fail(quoted(key) + " is not a line of a curve-skeleton; 'v' and 'l' are");
  }
  tidy_edges(skeleton);
  return skeleton;
}

}  // namespace marrow::skeleton_detail
