// A shape into a skeleton by the options of the command line.
#pragma once

#include <marrow/extract.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <variant>
#include <vector>

#include "command.hpp"
#include "statistics.hpp"
#include "volume_input.hpp"

namespace marrow {

/// All options that the skeleton depends on, and those of how it is made.
struct ExtractionRequest {
  int image = ExtractOptions{}.image_resolution;
  double closing = ExtractOptions{}.closing;
  int grid = ExtractOptions{}.grid_resolution;
  std::string silhouettes = "scanline";
  std::string rules = "marrow";
  std::string refine = "surface";
  std::string views = "21";
  std::vector<Vec3> directions;  ///< of a file that --views names
  bool largest = false;
  double min_part = 0;  ///< percent
  int threads = 0;
  std::string simd;
  VolumeRequest volume;
};

void add_extraction_options(CLI::App& verb, ExtractionRequest& request);

ExtractOptions options_of(const ExtractionRequest& request);

/// The parts that --largest and --min-part leave.
CurveSkeleton kept_parts(const ExtractionRequest& request, CurveSkeleton skeleton);

/// What the skeleton depends on: the options, and the input with its hash.
Statistics describe(const ExtractionRequest& request, bool is_volume);
Statistics describe(const InputFile& input);
/// Points and triangles, or voxels.
Statistics describe_size(const std::variant<Shape, Volume>& shape);

}  // namespace marrow
