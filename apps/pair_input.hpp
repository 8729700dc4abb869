// A shape and its skeleton as inputs: what the verbs that take both share.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "command.hpp"
#include "limits.hpp"
#include "volume_input.hpp"

namespace marrow {

struct PairRequest {
  std::string shape, skeleton;
  std::string from;  ///< format of the input that is -, else of the shape
  VolumeRequest volume;
  Limits limits;
};

/// Adds SHAPE, SKELETON, --from, and the options of volumes and limits.
void add_pair_options(CLI::App& verb, PairRequest& request);

/// Starts the clock of the limits. Throws Error: Usage (both are standard input).
void start_clock(const PairRequest& request);

/// Throw Error: CannotRead, Limit.
InputFile read_shape_of(const PairRequest& request);
InputFile read_skeleton_of(const PairRequest& request);

}  // namespace marrow
