#include "file_kind.hpp"

#include <algorithm>
#include <cstddef>

namespace marrow {

namespace {

/// The next line of `text`, without leading blanks; takes it away from `text`.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line;
}

/// Whether the first words of `line` are `words`, which stand one blank apart.
bool begins_with(std::string_view line, std::string_view words) {
  return line.starts_with(words) && (line.size() == words.size() || line[words.size()] == ' ' ||
                                     line[words.size()] == '\t' || line[words.size()] == '\r');
}

}  // namespace

bool obj_is_skeleton(std::string_view bytes) {
  if (bytes.starts_with("# marrow curve-skeleton")) return true;
  bool has_lines = false;
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    if (begins_with(line, "f")) return false;
    has_lines = has_lines || begins_with(line, "l");
  }
  return has_lines;
}

bool ply_is_skeleton(std::string_view bytes) {
  bool has_edges = false, has_faces = false;
  // A header is text; where it does not end, the reader of the file will say so.
  bytes = bytes.substr(0, std::size_t{1} << 16);
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    if (begins_with(line, "end_header")) break;
    has_edges = has_edges || begins_with(line, "element edge");
    has_faces = has_faces || begins_with(line, "element face");
  }
  return has_edges && !has_faces;
}

bool csv_is_skeleton(std::string_view bytes) {
  return take_line(bytes).find("neighbours") != std::string_view::npos;
}

}  // namespace marrow
