// The rows of a batch as a table.
#include <marrow/file_io.hpp>

#include "merge_rows.hpp"

namespace marrow {

namespace {

struct Column {
  const char* name;
  std::vector<const char*> keys;  ///< the way to the value
};

const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"id", {"id"}},
      {"status", {"status"}},
      {"error", {"error"}},
      {"file", {"input", "file"}},
      {"format", {"input", "format"}},
      {"bytes", {"input", "bytes"}},
      {"hash", {"input", "hash"}},
      {"points", {"input", "points"}},
      {"triangles", {"input", "triangles"}},
      {"foreground", {"input", "foreground"}},
      {"nodes", {"skeleton", "nodes"}},
      {"edges", {"skeleton", "edges"}},
      {"components", {"skeleton", "components"}},
      {"cycles", {"skeleton", "cycles"}},
      {"leaves", {"skeleton", "leaves"}},
      {"joints", {"skeleton", "joints"}},
      {"branches", {"skeleton", "branches"}},
      {"length", {"skeleton", "length"}},
      {"version", {"version"}},
  };
  return all;
}

const std::vector<Column>& run_columns() {
  static const std::vector<Column> all{
      {"attempt", {"run", "attempt"}},           {"host", {"run", "host"}},
      {"wall_seconds", {"run", "wall_seconds"}}, {"cpu_seconds", {"run", "cpu_seconds"}},
      {"max_rss", {"run", "max_rss"}},
  };
  return all;
}

std::string cell_of(const Statistics& row, const Column& column) {
  const Statistics* value = &row;
  for (const char* key : column.keys) {
    if (!value->is_object() || !value->contains(key)) return "";
    value = &(*value)[key];
  }
  if (!value->is_string()) return value->dump();
  const std::string text = value->get<std::string>();
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

template <class Cell>
std::string line_of(bool with_run, Cell cell) {
  std::string line;
  for (const Column& column : columns()) line += (line.empty() ? "" : ",") + cell(column);
  if (with_run)
    for (const Column& column : run_columns()) line += "," + cell(column);
  return line + "\r\n";
}

}  // namespace

void write_csv(const std::string& path, const MergedRows& rows, bool with_run) {
  std::size_t next = 0;
  std::string line;
  write_file(path, [&]() -> std::string_view {
    if (next > rows.size()) return {};
    if (next == 0)
      line = line_of(with_run, [](const Column& column) { return std::string(column.name); });
    else
      line = line_of(with_run, [row = rows.row(next - 1)](const Column& column) {
        return cell_of(row, column);
      });
    ++next;
    return line;
  });
}

}  // namespace marrow
