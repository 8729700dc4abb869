// The stages of extract(), each alone on what the stages before it gave.
#pragma once

#include <marrow/extract.hpp>
#include <marrow/shape.hpp>

#include <span>

namespace marrow {

/// A shape and all that the stages take.
struct Workload {
  Shape shape;
  ExtractOptions options;
  NormalizedShape normalized;
  ExtractTrace trace;
  VoteGraph unchecked;  ///< what the check of the cycles gets
};

/// Runs the whole method once.
Workload prepare(Shape shape, const ExtractOptions& options);

/// One part of extract(), on one thread.
struct Stage {
  const char* name;
  void (*run)(const Workload&);
};

/// In the order of the paper. Together they do what extract() does.
std::span<const Stage> stages();

/// What one of the 21 tasks of the stage "views" does: frame, silhouettes, distances, axes.
void draw_view_pair(const Workload& work, std::size_t view);

}  // namespace marrow
