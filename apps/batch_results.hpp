// Rows of results, one JSON object a line.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "batch_items.hpp"
#include "statistics.hpp"

namespace marrow {

/// Where a row stands in its file, and when it was written: of the rows of a shape the last counts.
struct RowPlace {
  std::uint64_t offset = 0, size = 0;  ///< without the end of the line
  double ended = 0;                    ///< Unix time, never less than that of the row before
};

/// Calls `take` for every row of `path` in order; lines that are no whole row, as a crash of the
/// machine leaves them, are passed over and counted. Throws Error: CannotRead.
std::uint64_t for_each_row(const std::string& path,
                           const std::function<void(const Statistics&, const RowPlace&)>& take);

/// The text under `key`, empty where there is none.
std::string text_at(const Statistics& object, const std::string& key);

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

/// The status of a row whose worker was killed, but not by us nor by what its shape did: by a
/// person, or where memory was short. The shape is to be tried again.
inline constexpr const char* kKilled = "killed";

/// What earlier runs say of a shape.
struct Prior {
  double ended = -1;
  std::uint64_t attempt = 0;  ///< 0: nothing
  bool is_done = false;
  bool is_to_repeat = false;  ///< no fault of the shape: the disk was full, or it was killed
  std::uint64_t setting = 0;  ///< hash of options and version
  std::string hash;           ///< of the input; empty if it could not be read
  std::vector<std::uint64_t> output_sizes;  ///< in the order of the kinds asked for
};

/// The hash that stands for the options and the version of a row.
std::uint64_t setting_of(const Statistics& row);

/// For each item of the shard what the results in `folder` say, and how many lines were no rows.
/// Those of other shards of the same number are not read: they have none of these items.
/// Throws Error: CannotRead.
std::vector<Prior> priors_of(const std::vector<BatchItem>& items, const std::string& folder,
                             const Shard& shard, std::uint64_t& torn);

}  // namespace marrow
