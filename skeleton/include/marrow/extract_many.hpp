// Many shapes at a time.
#pragma once

#include <marrow/error.hpp>
#include <marrow/extract.hpp>

#include <optional>
#include <span>
#include <vector>

namespace marrow {

/// What became of a shape: its skeleton, or why there is none.
struct ExtractResult {
  CurveSkeleton skeleton;
  std::optional<Error> error;
};

/// extract() of each shape, in their order. All `max_threads` threads work on shapes side by side,
/// and on the views of those that are left when there are fewer shapes than threads; the skeletons
/// are the bytes that extract() gives. A failure is that of its shape alone, also Limit when memory
/// runs out. `on_stage` is not called. Memory grows with the number of threads, not of shapes, but
/// for the results.
/// Throws Error: Usage (an option out of range), for all shapes.
std::vector<ExtractResult> extract_many(std::span<const Shape> shapes,
                                        const ExtractOptions& options = {});

}  // namespace marrow
