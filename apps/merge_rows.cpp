#include "merge_rows.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <algorithm>
#include <fstream>
#include <tuple>

#include "batch_folder.hpp"

namespace marrow {

MergedRows::MergedRows(std::vector<std::string> folders) : folders_(std::move(folders)) {
  for (std::size_t folder = 0; folder < folders_.size(); ++folder)
    for (const std::string& path : results_in(folders_[folder])) files_.push_back({path, folder});
  if (files_.empty())
    throw Error(ErrorKind::Usage, folders_.front() + ": holds no results of marrow batch");
  for (std::uint32_t file = 0; file < files_.size(); ++file)
    torn_ += for_each_row(files_[file].path, [&](const Statistics& row, const RowPlace& place) {
      rows_.push_back({text_at(row, "id"), file, place});
    });
  std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
    return std::tie(a.id, a.place.ended) < std::tie(b.id, b.place.ended);
  });
  // Of each id the last one stays.
  const auto first = std::unique(rows_.rbegin(), rows_.rend(),
                                 [](const Row& a, const Row& b) { return a.id == b.id; });
  rows_.erase(rows_.begin(), first.base());
}

Statistics MergedRows::row(std::size_t i) const {
  const Row& row = rows_[i];
  const std::string& path = files_[row.file].path;
  std::ifstream in(path, std::ios::binary);
  std::string line(row.place.size, '\0');
  in.seekg(static_cast<std::streamoff>(row.place.offset));
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  Statistics result = Statistics::parse(line, nullptr, false);
  if (!in || !result.is_object())
    throw Error(ErrorKind::CannotRead, path + ": cannot be read: it has changed meanwhile");
  return result;
}

void write_json_lines(const std::string& path, const MergedRows& rows, bool with_run) {
  std::size_t next = 0;
  std::string line;
  write_file(path, [&]() -> std::string_view {
    if (next == rows.size()) return {};
    Statistics row = rows.row(next++);
    if (!with_run) row.erase("run");
    line = row.dump(-1, ' ', false, Statistics::error_handler_t::replace) + "\n";
    return line;
  });
}

}  // namespace marrow
