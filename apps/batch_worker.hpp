// One shape of a batch, in a process of its own.
#pragma once

#include <string>
#include <vector>

#include "batch_items.hpp"
#include "limits.hpp"

namespace marrow {

/// What a batch makes of every shape.
struct BatchOutputs {
  std::string folder;
  std::vector<std::string> formats;  ///< of skeletons
  bool with_picture = false;
  std::string map_format;  ///< of the map of the surface; none if empty

  /// Formats, "png" and "map.csv" or the like, in the order in which they are written.
  std::vector<std::string> kinds() const;
};

struct WorkerTask {
  const BatchItem& item;
  const ShapeOptions& options;
  const BatchOutputs& outputs;
  const std::string& work_folder;
  ReadOptions limits;
  std::uint64_t max_memory = 0;  ///< bytes, 0 for no limit
};

/// Reads the shape, writes its outputs and tells `reply`, an open file, in JSON objects, a line
/// each, that belong together: "input" as soon as it is known; "status", and "error", or "outputs"
/// with their sizes and "skeleton"; "run" with the seconds of each stage.
void run_worker(const WorkerTask& task, int reply);

}  // namespace marrow
