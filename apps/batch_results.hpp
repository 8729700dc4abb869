// Rows of results, one JSON object a line.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "batch_items.hpp"
#include "statistics.hpp"

namespace marrow {

/// Where a row stands in its file.
struct RowPlace {
  std::uint64_t offset = 0, size = 0;  ///< without the end of the line
};

/// Calls `take` for every row of `path` in order; lines that are no whole row, as a crash of the
/// machine leaves them, are passed over and counted. Throws Error: CannotRead.
std::uint64_t for_each_row(const std::string& path,
                           const std::function<void(const Statistics&, const RowPlace&)>& take);

/// The text under `key`, empty where there is none.
std::string text_at(const Statistics& object, const std::string& key);

/// How often the shape of this row has been tried: the row with the highest number counts.
std::uint64_t attempt_of(const Statistics& row);

/// A file of rows that only grows, and only by whole rows.
class ResultLog {
 public:
  /// Cuts off a last line that a killed run left torn. Throws Error: CannotWrite.
  explicit ResultLog(const std::string& path);
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;
  ~ResultLog();

  /// Throws Error: CannotWrite; the file is then as before.
  void append(const Statistics& row);
  /// Waits until the rows are on the disk.
  void sync();

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

/// What earlier runs say of a shape.
struct Prior {
  std::uint64_t attempt = 0;  ///< 0: nothing
  bool is_done = false;
  bool is_our_fault = false;                ///< the disk was full or the like: to be done again
  std::uint64_t setting = 0;                ///< hash of options and version
  std::string hash;                         ///< of the input; empty if it could not be read
  std::vector<std::uint64_t> output_sizes;  ///< in the order of the kinds asked for
};

/// The hash that stands for the options and the version of a row.
std::uint64_t setting_of(const Statistics& row);

/// For each item what all results in `folder` say, and how many lines were no rows.
/// Throws Error: CannotRead.
std::vector<Prior> priors_of(const std::vector<BatchItem>& items, const std::string& folder,
                             std::uint64_t& torn);

}  // namespace marrow
