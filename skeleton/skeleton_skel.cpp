// The file of the paper's authors, which cinolib calls LIVESU2012.
#include <utility>

#include "neighbour_rows_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr std::string_view kHeader = "ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST";
constexpr std::size_t kLeastRow = sizeof "0 0 0 0 1 0" - 1;

void read_header(Lines& lines) {
  lines.expect("the header '" + std::string(kHeader) + "'");
  std::string first;
  for (const auto word : lines.words()) {
    if (!first.empty()) first += ' ';
    first += word;
  }
  if (first != kHeader) lines.fail("the first line is not '" + std::string(kHeader) + "'");
}

void read_row(const Lines& lines, NeighbourRows& rows) {
  const std::int64_t id = lines.integer(0);
  const CurveSkeleton::Node node{{lines.number(1), lines.number(2), lines.number(3)},
                                 lines.radius(4)};
  rows.add(id, node, lines.line());
  const std::uint64_t neighbours = lines.count(5);
  if (neighbours != lines.words().size() - 6)
    lines.fail("the line claims " + std::to_string(neighbours) + " neighbours and lists " +
               std::to_string(lines.words().size() - 6));
  for (std::size_t i = 6; i < lines.words().size(); ++i)
    rows.add_neighbour(lines.integer(i), lines.line());
}

}  // namespace

std::string format_skel(const CurveSkeleton& skeleton) {
  std::string text(kHeader);
  text += '\n';
  append(text, std::uint64_t{skeleton.nodes.size()});
  text += '\n';
  const auto neighbours = neighbours_of(skeleton);
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    append(text, std::uint64_t{i});
    text += ' ';
    append(text, skeleton.nodes[i], " ");
    text += ' ';
    append(text, std::uint64_t{neighbours[i].size()});
    text += ' ';  // the original ends every number with a blank, the last one too
    for (const NodeId n : neighbours[i]) {
      append(text, std::uint64_t{n});
      text += ' ';
    }
    text += '\n';
  }
  return text;
}

CurveSkeleton parse_skel(std::string_view bytes, const Source& source) {
  Lines lines(bytes, source);
  read_header(lines);
  lines.expect("the count of nodes");
  if (lines.words().size() != 1) lines.fail("the second line is not the count of nodes");
  const std::uint64_t count = lines.count(0);
  if (count > lines.bytes_left() / kLeastRow + 1)
    lines.fail("the file claims " + std::to_string(count) + " nodes and is too short for them");
  NeighbourRows rows;
  rows.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    lines.expect("node " + std::to_string(i + 1) + " of " + std::to_string(count));
    read_row(lines, rows);
  }
  if (lines.next()) lines.fail("the file goes on after its " + std::to_string(count) + " nodes");
  return std::move(rows).finish(source);
}

}  // namespace marrow::skeleton_detail
