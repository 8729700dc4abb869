// SWC, the trees of neuroscience: every node but the root of a part names its parent. Edges that
// close cycles do not fit and are comments, which our reader takes.
#include <marrow/disjoint_sets.hpp>

#include <algorithm>

#include "skeleton_text_detail.hpp"
#include "spanning_forest_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

void append_loops(std::string& text, const CurveSkeleton& skeleton, const SpanningForest& forest) {
  std::vector<std::array<std::uint64_t, 2>> loops;
  for (const auto& [a, b] : skeleton.edges)
    if (forest.parent[a] != b && forest.parent[b] != a)
      loops.push_back(
          {std::min(forest.row[a], forest.row[b]), std::max(forest.row[a], forest.row[b])});
  std::sort(loops.begin(), loops.end());
  for (const auto& [a, b] : loops) {
    text += "# loop-edge ";
    append(text, a);
    text += ' ';
    append(text, b);
    text += '\n';
  }
}

/// A line that names another by its id.
struct Link {
  NodeId from;
  std::int64_t from_id, to_id;
  std::size_t line;
  bool is_parent;  ///< or an edge that closes a cycle
};

struct Rows {
  CurveSkeleton skeleton;
  NodeIds ids;
  std::vector<Link> links;
};

void read_row(const Lines& lines, Rows& rows) {
  if (lines.words().size() < 7)
    lines.fail("a node is 'id type x y z radius parent'; this line has " +
               std::to_string(lines.words().size()) + " words");
  const auto node = static_cast<NodeId>(rows.skeleton.nodes.size());
  const std::int64_t id = lines.integer(0), parent = lines.integer(6);
  lines.integer(1);  // the type
  rows.ids.add(id, lines.line());
  rows.skeleton.nodes.push_back(
      {{lines.number(2), lines.number(3), lines.number(4)}, lines.radius(5)});
  if (parent != -1) rows.links.push_back({node, id, parent, lines.line(), true});
}

/// `# loop-edge i j`; other comments say nothing.
void read_comment(const Lines& lines, Rows& rows) {
  const auto& words = lines.words();
  if (words.size() < 2 || words[0] != "#" || words[1] != "loop-edge") return;
  if (words.size() != 4) lines.fail("an edge that closes a cycle is '# loop-edge i j'");
  rows.links.push_back({kNoParent, lines.integer(2), lines.integer(3), lines.line(), false});
}

void connect(Rows& rows, const Source& source) {
  rows.ids.sort(source);
  DisjointSets parts(rows.skeleton.nodes.size());
  for (const Link& link : rows.links) {
    const auto find = [&](std::int64_t id, const char* what) {
      return rows.ids.find(id, what, link.line, source);
    };
    const NodeId a = link.is_parent ? link.from : find(link.from_id, "node");
    const NodeId b = find(link.to_id, link.is_parent ? "parent" : "node");
    if (a == b) fail(source.name, link.line, "an edge from a node to itself");
    if (link.is_parent && !parts.join(a, b))
      fail(source.name, link.line,
           "the parents of node " + std::to_string(link.from_id) +
               " lead back to it; an edge that closes a cycle is '# loop-edge i j'");
    rows.skeleton.edges.push_back({a, b});
  }
}

}  // namespace

std::string format_swc(const CurveSkeleton& skeleton) {
  std::string text = "# marrow curve-skeleton\n# id type x y z radius parent\n";
  const SpanningForest forest = spanning_forest(skeleton);
  for (const NodeId n : forest.order) {
    append(text, forest.row[n]);
    text += " 0 ";
    append(text, skeleton.nodes[n], " ");
    text += ' ';
    if (forest.parent[n] == kNoParent)
      text += "-1";
    else
      append(text, forest.row[forest.parent[n]]);
    text += '\n';
  }
  append_loops(text, skeleton, forest);
  return text;
}

CurveSkeleton parse_swc(std::string_view bytes, const Source& source) {
  Rows rows;
  for (Lines lines(bytes, source); lines.next();) {
    if (lines.words()[0][0] == '#')
      read_comment(lines, rows);
    else
      read_row(lines, rows);
  }
  connect(rows, source);
  tidy_edges(rows.skeleton);
  return std::move(rows.skeleton);
}

}  // namespace marrow::skeleton_detail
