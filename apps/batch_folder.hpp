// The folder that a batch writes to:
//
//   results-0-of-1.jsonl     a row for each shape, one file for each shard
//   skeletons/ID.skel        and other formats beside it
//   pictures/ID.png          with --render
//   maps/ID.csv              with --map
//   .work-0-of-1             while the shard runs: files that are not whole yet
#pragma once

#include <string>
#include <vector>

#include "batch_items.hpp"

namespace marrow {

/// "results-0-of-1.jsonl" in `folder`.
std::string results_path(const std::string& folder, const Shard& shard);

/// The results of all shards and of earlier runs with other shards, by name.
/// Throws Error: CannotRead.
std::vector<std::string> results_in(const std::string& folder);

/// Whether these are results of the same number of shards, but of another one.
bool is_of_another_shard(const std::string& results, const std::string& folder, const Shard& shard);

/// Kinds of outputs besides the formats of skeletons.
inline constexpr const char* kPicture = "png";
inline constexpr const char* kMap = "map.";  ///< before its format

/// Where the output `kind` ("skel", ..., "png", "map.csv", ...) of a shape goes.
std::string output_path(const std::string& folder, const std::string& kind, const std::string& id);

/// The work folder of a shard, and the lock that keeps a second run of the same shard out. What
/// runs that were killed left in theirs is removed, here and at the end.
class WorkFolder {
 public:
  /// Makes `folder` too. Throws Error: CannotWrite, Usage (the shard is being run).
  WorkFolder(const std::string& folder, const Shard& shard);
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int lock_ = -1;
};

}  // namespace marrow
