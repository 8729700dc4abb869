// Volumes as inputs: their options, and shapes and volumes alike.
#pragma once

#include <marrow/volume_io.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <variant>

#include "command.hpp"

namespace marrow {

/// What the words of a command say about a volume.
struct VolumeRequest {
  double iso = 0;
  std::uint64_t max_voxels = VolumeOptions{}.max_voxels;
  std::string dims, type = "u8", spacing = "1,1,1";
};

/// Adds --iso, --dims, --type, --spacing and --max-voxels.
void add_volume_options(CLI::App& verb, VolumeRequest& request);

/// Throws Error: Usage.
VolumeOptions volume_options_of(const VolumeRequest& request);

bool is_volume(const InputFile& file);

/// Throws Error: Usage, CannotRead, Unsupported, Malformed, Limit.
Volume volume_of(const InputFile& file, const VolumeRequest& request);

/// The shape or the volume in a file.
std::variant<Shape, Volume> shape_or_volume_of(const InputFile& file, const VolumeRequest& request);

}  // namespace marrow
