// A table with a row for every node; its neighbours stand in one field, apart by blanks.
#include <algorithm>
#include <limits>

#include "neighbour_rows_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr std::size_t kMissing = std::numeric_limits<std::size_t>::max();

/// Where the columns are that are read; others are passed over.
struct Columns {
  std::size_t id, x, y, z, radius, section, neighbours, count;
};

std::size_t find_column(const Lines& lines, std::string_view name) {
  const auto& words = lines.words();
  const auto found = std::find(words.begin(), words.end(), name);
  return found == words.end() ? kMissing : static_cast<std::size_t>(found - words.begin());
}

Columns read_header(Lines& lines) {
  lines.expect("the names of the columns");
  const auto column = [&](std::string_view name) {
    const std::size_t found = find_column(lines, name);
    if (found == kMissing)
      lines.fail("no column '" + std::string(name) +
                 "'; a curve-skeleton has id,x,y,z,radius,neighbours");
    return found;
  };
  return {column("id"),
          column("x"),
          column("y"),
          column("z"),
          find_column(lines, "radius"),
          find_column(lines, "section_radius"),
          column("neighbours"),
          lines.words().size()};
}

void read_neighbours(const Lines& lines, std::string_view field, NeighbourRows& rows) {
  std::vector<std::string_view> words;
  split(field, words);
  for (const auto word : words) {
    std::int64_t to = 0;
    if (!read_number(word, to)) lines.fail(quoted(word) + " is not an id");
    rows.add_neighbour(to, lines.line());
  }
}

void read_row(const Lines& lines, const Columns& columns, NeighbourRows& rows) {
  if (lines.words().size() != columns.count)
    lines.fail("a row has " + std::to_string(lines.words().size()) +
               " fields, the first line has " + std::to_string(columns.count));
  const std::int64_t id = lines.integer(columns.id);
  CurveSkeleton::Node row{
      {lines.number(columns.x), lines.number(columns.y), lines.number(columns.z)},
      lines.radius(columns.radius)};
  if (columns.section != kMissing)
    row.section_radius = lines.section_radius(columns.section, row.radius);
  rows.add(id, row, lines.line());
  read_neighbours(lines, lines.words()[columns.neighbours], rows);
}

}  // namespace

std::string format_csv(const CurveSkeleton& skeleton) {
  const bool with_sections = has_section_radii(skeleton);
  std::string text = "id,x,y,z,radius,";
  if (with_sections) text += "section_radius,";
  text += "component,neighbours\n";
  const auto neighbours = neighbours_of(skeleton);
  const auto component = component_of_nodes(skeleton);
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    append(text, std::uint64_t{i});
    text += ',';
    append(text, skeleton.nodes[i], ",");
    if (with_sections) {
      text += ',';
      append(text, skeleton.nodes[i].section_radius);
    }
    text += ',';
    append(text, std::uint64_t{component[i]});
    text += ',';
    for (const NodeId n : neighbours[i]) {
      if (text.back() != ',') text += ' ';
      append(text, std::uint64_t{n});
    }
    text += '\n';
  }
  return text;
}

CurveSkeleton parse_csv(std::string_view bytes, const Source& source) {
  Lines lines(bytes, source, ',');
  const Columns columns = read_header(lines);
  NeighbourRows rows;
  while (lines.next()) read_row(lines, columns, rows);
  return std::move(rows).finish(source);
}

}  // namespace marrow::skeleton_detail
