// marrow map: which node, branch and part of a skeleton every point of a shape belongs to.
#include <marrow/error.hpp>

#include <memory>

#include "command.hpp"
#include "map_file.hpp"
#include "pair_input.hpp"

namespace marrow {

namespace {

struct MapRequest {
  PairRequest pair;
  std::string out, to;
};

void run_map(const MapRequest& request) {
  start_clock(request.pair);
  const MapFormat format = map_format_of(request.to.empty() ? request.out : "x." + request.to);
  check_outputs({request.out}, {request.pair.shape, request.pair.skeleton});
  const auto shape = shape_or_volume_of(read_shape_of(request.pair), request.pair.volume);
  const InputFile lines = read_skeleton_of(request.pair);
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
  verb->add_option("-o,--output", request->out,
                   "The map: .csv .json, .ply, which is coloured by branch, or .glb, the shape "
                   "with joints and\n"
                   "skin weights; - is standard output")
      ->required()
      ->type_name("FILE");
  add_format_option(*verb, "--to", request->to, "Format of the output, whatever its extension",
                    {"csv", "json", "ply", "glb"});
  add_pair_options(*verb, request->pair);
  verb->footer(
      "The node, branch and part of every point of SHAPE, or of every foreground voxel, all\n"
      "counted from 0. Branches spread along the surface from where it sees their lines, so\n"
      "that nothing is mapped across a gap.\n"
      "\n"
      "Examples:\n"
      "  marrow map horse.obj horse.skel -o horse.csv\n"
      "  marrow map horse.obj horse.skel -o coloured.ply\n"
      "  marrow convert horse.skel bones.skel --simplify 0.005\n"
      "  marrow map horse.obj bones.skel -o rigged.glb               joints and skin weights\n"
      "  marrow extract horse.obj -o horse.obj --map horse.json      both in one go\n");
  verb->callback([request] { run_map(*request); });
}

}  // namespace marrow
