// The row of a shape: all that is not under "run" is the same for the same input, options and
// version.
#pragma once

#include "batch_items.hpp"
#include "batch_pool.hpp"
#include "batch_results.hpp"
#include "batch_worker.hpp"

namespace marrow {

/// The row before anything has been done: "id", "options" and "version".
Statistics row_before(const BatchItem& item, const ShapeOptions& options,
                      const BatchOutputs& outputs);

/// The row in the end. A worker that has not told its own end is told of.
Statistics row_after(Statistics row, const BatchItem& item, const WorkerEnd& end,
                     std::uint64_t attempt, int timeout);

/// Whether nothing has changed since `prior` was written: not the options and the version, of
/// which `row` tells, not the bytes of the shape, and the outputs are there.
bool is_unchanged(const Prior& prior, const Statistics& row, const BatchItem& item,
                  const BatchOutputs& outputs);

}  // namespace marrow
