// marrow map: which node, branch and part of a skeleton every point of a shape belongs to.
#include <marrow/error.hpp>

#include <memory>

#include "command.hpp"
#include "limits.hpp"
#include "map_file.hpp"
#include "volume_input.hpp"

namespace marrow {

namespace {

struct MapRequest {
  std::string shape, skeleton, from, out, to;
  VolumeRequest volume;
  Limits limits;
};

void run_map(const MapRequest& request) {
  start_clock(request.limits, request.shape);
  const MapFormat format = map_format_of(request.to.empty() ? request.out : "x." + request.to);
  if (request.shape == "-" && request.skeleton == "-")
    throw Error(ErrorKind::Usage, "only one of SHAPE and SKELETON can be standard input");
  check_outputs({request.out}, {request.shape, request.skeleton});
  const bool shape_is_named = request.skeleton != "-";
  const auto read = [&](const std::string& path, bool is_named) {
    return read_input(path, is_named ? request.from : "", request.limits.read);
  };
  const auto shape = shape_or_volume_of(read(request.shape, shape_is_named), request.volume);
  const InputFile lines = read(request.skeleton, !shape_is_named);
  const CurveSkeleton skeleton = skeleton_of(lines);
  try {
    write_outputs({{request.out, map_file(shape, skeleton, format)}});
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::Empty) throw;
    throw Error(e.kind(), lines.name + ": " + e.what());
  }
}

}  // namespace

void add_map_command(CLI::App& program) {
  const auto request = std::make_shared<MapRequest>();
  CLI::App* verb = program.add_subcommand("map", "From the surface of a shape to its skeleton");
  verb->add_option(
          "SHAPE", request->shape,
          "Shape (.obj .ply .stl .off), point cloud (.xyz .pcd) or volume (.nrrd .nhdr .nii\n"
          ".binvox .raw, .nii.gz .raw.gz), or -")
      ->required()
      ->type_name("");
  verb->add_option("SKELETON", request->skeleton,
                   "Its skeleton: all that marrow convert reads, or -")
      ->required()
      ->type_name("");
  verb->add_option(
          "-o,--output", request->out,
          "The map: .csv .json, or .ply, which is coloured by branch; - is standard output")
      ->required()
      ->type_name("FILE");
  add_format_option(*verb, "--from", request->from, "Format of the input that is -, else of SHAPE",
                    input_and_skeleton_formats());
  add_format_option(*verb, "--to", request->to, "Format of the output, whatever its extension",
                    {"csv", "json", "ply"});
  add_volume_options(*verb, request->volume);
  add_limit_options(*verb, request->limits);
  verb->footer(
      "The node, branch and part of every point of SHAPE, or of every foreground voxel, all\n"
      "counted from 0. Branches spread along the surface from where it sees their lines, so\n"
      "that nothing is mapped across a gap.\n"
      "\n"
      "Examples:\n"
      "  marrow map horse.obj horse.skel -o horse.csv\n"
      "  marrow map horse.obj horse.skel -o coloured.ply\n"
      "  marrow extract horse.obj -o horse.obj --map horse.json      both in one go\n");
  verb->callback([request] { run_map(*request); });
}

}  // namespace marrow
