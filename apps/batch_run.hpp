// A batch: all shapes of a shard through worker processes, their rows into a file.
#pragma once

#include "batch_items.hpp"
#include "batch_worker.hpp"
#include "limits.hpp"

namespace marrow {

struct BatchRequest {
  BatchSources sources;
  Shard shard;
  ShapeOptions options;
  BatchOutputs outputs;
  Limits limits;  ///< the time is that of each shape
  std::uint64_t max_memory = 0;
  int jobs = 1;
  bool resume = false, retry = false, quiet = false;
};

/// Runs the batch and says how it ended; SIGINT, SIGTERM and SIGHUP let the shapes under way end, a
/// second one does not. The exit status: 0, 9 with failures, 128 and the signal.
/// Throws Error: Usage, CannotRead, Malformed, CannotWrite.
int run_batch(const BatchRequest& request);

}  // namespace marrow
