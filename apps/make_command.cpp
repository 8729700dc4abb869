// marrow make: shapes whose skeletons are known.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/shape_io.hpp>
#include <marrow/skeleton_io.hpp>
#include <marrow/volume_io.hpp>

#include <analytic_shapes.hpp>
#include <voxelise.hpp>

#include <algorithm>
#include <memory>

#include "command.hpp"

namespace marrow {

namespace {

struct MakeRequest {
  std::string name, out, to, truth;
  double resolution = 1;
  int pose = 0;
  int voxels = 128;
  bool list = false;
};

void list_shapes() {
  std::size_t longest = 0;
  for (const auto& shape : analytic_shapes())
    longest = std::max(longest, std::string(shape.name).size());
  std::string text;
  for (const auto& shape : analytic_shapes()) {
    std::string name = shape.name;
    name.resize(longest + 2, ' ');
    text += name + shape.note + "\n";
  }
  write_file("-", text);
}

std::string format_truth(const AnalyticShape& made, const std::string& path) {
  if (path.ends_with(".gt.json")) return format_truth_json(made);
  return format_skeleton(made.truth, skeleton_format_of(path));
}

bool is_volume(const MakeRequest& request) {
  return request.to == "nrrd" || (request.to.empty() && extension_of(request.out) == "nrrd");
}

std::string format_made(const AnalyticShape& made, const MakeRequest& request) {
  if (!is_volume(request))
    return format_shape(made.shape, output_shape_format(request.out, request.to));
  if (made.surface == SurfaceKind::Flat)
    throw Error(ErrorKind::Usage, made.name + " has no inside; make it as .obj .ply .stl or .off");
  return format_nrrd(voxelise(made.shape, request.voxels));
}

void run_make(const MakeRequest& request) {
  if (request.list) return list_shapes();
  if (request.name.empty())
    throw Error(ErrorKind::Usage, "NAME is missing; marrow make --list shows all names");
  if (request.out.empty())
    throw Error(ErrorKind::Usage, "-o FILE is missing; see marrow make --help");
  std::vector<std::string> outputs{request.out};
  if (!request.truth.empty()) outputs.push_back(request.truth);
  check_outputs(outputs, {});
  if (!is_volume(request)) output_shape_format(request.out, request.to);
  if (!request.truth.empty()) skeleton_format_of(request.truth);

  const AnalyticShape made = make_analytic_shape(request.name, {request.resolution, request.pose});
  std::vector<OutputFile> files{{request.out, format_made(made, request)}};
  if (!request.truth.empty()) files.push_back({request.truth, format_truth(made, request.truth)});
  write_outputs(files);
}

}  // namespace

void add_make_command(CLI::App& program) {
  const auto request = std::make_shared<MakeRequest>();
  CLI::App* verb = program.add_subcommand("make", "A shape whose skeleton is known");
  verb->add_option("NAME", request->name, "Which shape; see --list")->type_name("");
  verb->add_option("-o,--output", request->out,
                   "File for the shape: .obj .ply .stl .off, .nrrd for voxels, or -")
      ->type_name("FILE");
  add_format_option(*verb, "--to", request->to, "Format of the output, whatever its extension",
                    {"obj", "ply", "stl", "off", "nrrd"});
  verb->add_option(
          "--truth", request->truth,
          "File for its exact skeleton: .obj .skel .ply .json and others, or .gt.json with the "
          "counts to expect and whole branches")
      ->type_name("FILE");
  verb->add_option("--resolution", request->resolution, "Factor on the number of faces")
      ->type_name("0.5..50")
      ->capture_default_str();
  verb->add_option(
          "--pose", request->pose,
          "Bend the limbs of a body at random, the same for the same number; 0: not at all")
      ->check(CLI::Range(0, kMostPose).description(""))
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--voxels", request->voxels, "Of .nrrd: voxels along the longest side")
      ->check(CLI::Range(8, 1024).description(""))
      ->type_name("8..1024")
      ->capture_default_str();
  verb->add_flag("--list", request->list, "The names of all shapes");
  verb->footer(
      "Examples:\n"
      "  marrow make --list\n"
      "  marrow make torus -o torus.obj --truth torus.gt.json\n"
      "  marrow make trefoil -o trefoil.nrrd --voxels 256\n"
      "  marrow make stick-figure -o dancer.ply --pose 7\n"
      "  marrow make trefoil -o - --to ply --resolution 4 | marrow info - --from ply\n");
  verb->callback([request] { run_make(*request); });
}

}  // namespace marrow
