#include "pair_input.hpp"

#include <marrow/error.hpp>

namespace marrow {

namespace {

bool shape_is_named(const PairRequest& request) { return request.skeleton != "-"; }

}  // namespace

void add_pair_options(CLI::App& verb, PairRequest& request) {
  verb.add_option(
          "SHAPE", request.shape,
          "Shape (.obj .ply .stl .off), point cloud (.xyz .pcd) or volume (.nrrd .nhdr .nii\n"
          ".binvox .raw, .nii.gz .raw.gz), or -")
      ->required()
      ->type_name("");
  verb.add_option("SKELETON", request.skeleton, "Its skeleton: all that marrow convert reads, or -")
      ->required()
      ->type_name("");
  add_format_option(verb, "--from", request.from, "Format of the input that is -, else of SHAPE",
                    input_and_skeleton_formats());
  add_volume_options(verb, request.volume);
  add_limit_options(verb, request.limits);
}

void start_clock(const PairRequest& request) {
  start_clock(request.limits, request.shape);
  if (request.shape == "-" && request.skeleton == "-")
    throw Error(ErrorKind::Usage, "only one of SHAPE and SKELETON can be standard input");
}

InputFile read_shape_of(const PairRequest& request) {
  return read_input(request.shape, shape_is_named(request) ? request.from : "",
                    request.limits.read);
}

InputFile read_skeleton_of(const PairRequest& request) {
  return read_input(request.skeleton, shape_is_named(request) ? "" : request.from,
                    request.limits.read);
}

}  // namespace marrow
