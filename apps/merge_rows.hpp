// The rows of many shards, and what is made of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch_results.hpp"
#include "statistics.hpp"

namespace marrow {

/// One row for each id, by id: the last one.
class MergedRows {
 public:
  /// Reads all results in these folders. Throws Error: CannotRead, Usage (there are none).
  explicit MergedRows(std::vector<std::string> folders);

  std::size_t size() const { return rows_.size(); }
  std::uint64_t torn() const { return torn_; }

  /// Throws Error: CannotRead.
  Statistics row(std::size_t i) const;
  /// The folder that the shape's outputs are in.
  const std::string& folder(std::size_t i) const { return folders_[files_[rows_[i].file].folder]; }

 private:
  struct File {
    std::string path;
    std::size_t folder;
  };
  struct Row {
    std::string id;
    std::uint32_t file;
    RowPlace place;
  };

  std::vector<std::string> folders_;
  std::vector<File> files_;
  std::vector<Row> rows_;
  std::uint64_t torn_ = 0;
};

/// All rows as JSON, a line each; with what changes from run to run if asked for.
void write_json_lines(const std::string& path, const MergedRows& rows, bool with_run);

/// The same as a table, comma-separated (RFC 4180), with a line of names.
void write_csv(const std::string& path, const MergedRows& rows, bool with_run);

/// What has been done, for people: one HTML file that needs no other, with at most `pictures` of
/// the pictures. It tells of times, so it is not the same for every run.
void write_report(const std::string& path, const MergedRows& rows, std::size_t pictures);

}  // namespace marrow
