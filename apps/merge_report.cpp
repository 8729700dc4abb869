// What a batch has done, for people.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <optional>

#include "batch_folder.hpp"
#include "command.hpp"
#include "merge_rows.hpp"
#include "report_parts.hpp"

namespace marrow {

namespace {

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
    "<meta name=\"viewport\" content=\"width=device-width\"><title>Marrow: a batch</title><style>\n"
    "body{font:15px/1.4 sans-serif;margin:2em auto;max-width:80em;padding:0 1em;color:#222}\n"
    "table{border-collapse:collapse}td,th{padding:.2em .8em;border:1px solid #ccc;text-align:left;"
    "vertical-align:top;overflow-wrap:anywhere}\n"
    "figure{margin:0 1em 1em 0;display:inline-block;vertical-align:top}\n"
    ".histogram svg{max-width:100%}.histogram rect{fill:#4878a8}"
    ".histogram text{font-size:10px;text-anchor:middle}\n"
    ".sheet figure{width:15em}.sheet img{width:100%;border:1px solid #ccc}\n"
    ".sheet figcaption{font-size:12px;overflow-wrap:anywhere}\n"
    "</style></head><body>\n";

struct Summary {
  std::map<std::string, std::size_t> statuses;
  Causes causes;
  Histogram seconds, bytes, triangles, nodes;
  std::vector<std::size_t> with_picture;
};

std::optional<double> number_at(const Statistics& row, const char* group, const char* key) {
  const auto at = row.find(group);
  if (at == row.end() || !at->is_object()) return {};
  const auto value = at->find(key);
  if (value == at->end() || !value->is_number()) return {};
  return value->get<double>();
}

void add_number(Histogram& histogram, const Statistics& row, const char* group, const char* key) {
  if (const auto value = number_at(row, group, key)) histogram.add(*value);
}

Summary summarize(const MergedRows& rows) {
  Summary summary;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Statistics row = rows.row(i);
    const std::string status = text_at(row, "status");
    ++summary.statuses[status];
    if (status != "done")
      summary.causes.add(status, text_at(row, "error"),
                         text_at(row.value("input", Statistics()), "file"), text_at(row, "id"));
    add_number(summary.seconds, row, "run", "wall_seconds");
    add_number(summary.bytes, row, "input", "bytes");
    add_number(summary.triangles, row, "input", "triangles");
    add_number(summary.nodes, row, "skeleton", "nodes");
    if (number_at(row, "outputs", kPicture)) summary.with_picture.push_back(i);
  }
  return summary;
}

std::string overview(const Summary& summary, std::size_t shapes) {
  std::string html = "<h1>" + std::to_string(shapes) + " shapes</h1>\n<table>";
  for (const auto& [status, count] : summary.statuses)
    html += "<tr><td>" + html_text(status) + "</td><td>" + std::to_string(count) + "</td></tr>";
  html += "</table>\n<h2>Time and size</h2>\n";
  html += summary.seconds.svg("Time of a shape", "seconds");
  html += summary.bytes.svg("Size of a file", "bytes");
  html += summary.triangles.svg("Triangles of a shape", "number");
  html += summary.nodes.svg("Nodes of a skeleton", "number");
  const std::string causes = summary.causes.html();
  if (!causes.empty()) html += "<h2>Failures</h2>\n" + causes;
  return html;
}

std::string caption_of(const Statistics& row) {
  std::string caption = html_text(text_at(row, "id"));
  for (const char* key : {"components", "cycles", "leaves", "joints"})
    if (const auto count = number_at(row, "skeleton", key))
      caption += std::string("<br>") + key + " " + std::to_string(static_cast<long long>(*count));
  return caption;
}

/// Empty where the picture has gone.
std::string figure_of(const MergedRows& rows, std::size_t i) {
  const Statistics row = rows.row(i);
  try {
    const std::string png = read_file(output_path(rows.folder(i), kPicture, text_at(row, "id")));
    return "<figure><img alt=\"\" src=\"data:image/png;base64," + base64(png) + "\"><figcaption>" +
           caption_of(row) + "</figcaption></figure>\n";
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

void write_report(const std::string& path, const MergedRows& rows, std::size_t pictures) {
  const Summary summary = summarize(rows);
  const std::size_t all = summary.with_picture.size(), shown = std::min(all, pictures);
  std::string piece = kHead + overview(summary, rows.size());
  if (shown > 0) {
    piece += "<h2>Pictures</h2>\n";
    if (shown < all)
      piece +=
          "<p>" + std::to_string(shown) + " of " + std::to_string(all) + ", evenly by name.</p>\n";
    piece += "<div class=\"sheet\">\n";
  }
  const std::string end = std::string(shown > 0 ? "</div>\n" : "") + "<p>" +
                          html_text("marrow " + program_version()) + "</p>\n</body></html>\n";
  std::size_t next = 0;  // 0: the overview; then the pictures; then the end
  write_file(path, [&]() -> std::string_view {
    if (next > shown + 1) return {};
    if (next > 0)
      piece = next <= shown ? figure_of(rows, summary.with_picture[(next - 1) * all / shown]) : end;
    ++next;
    return piece.empty() ? "\n" : std::string_view(piece);
  });
}

}  // namespace marrow
