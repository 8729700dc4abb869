// marrow convert: a curve-skeleton from one format into another.
#include <marrow/capsule_mesh.hpp>
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/parts.hpp>

#include <memory>

#include "command.hpp"
#include "limits.hpp"

namespace marrow {

namespace {

struct ConvertRequest {
  std::string in, out, from, to;
  double radius = 0;  ///< of nodes that have none
  bool capsules = false, swc_split = false;
  Limits limits;
};

std::string format_capsules(const ConvertRequest& request, const CurveSkeleton& skeleton) {
  const Shape mesh = capsule_mesh(skeleton);
  if ((request.to.empty() ? extension_of(request.out) : request.to) == "glb")
    return format_glb(mesh);
  return format_shape(mesh, output_shape_format(request.out, request.to));
}

/// "a.swc" -> "a-1.swc", "a-2.swc", ... one for every part.
std::vector<OutputFile> split_swc(const ConvertRequest& request, const CurveSkeleton& skeleton) {
  if (request.out == "-" || output_skeleton_format(request.out, request.to) != SkeletonFormat::Swc)
    throw Error(ErrorKind::Usage,
                "--swc-split writes files NAME-1.swc, NAME-2.swc, ...; give a .swc file");
  const std::size_t extension = extension_of(request.out) == "swc" ? sizeof ".swc" - 1 : 0;
  const std::string stem = request.out.substr(0, request.out.size() - extension);
  std::vector<OutputFile> files;
  for (const CurveSkeleton& part : parts_of(skeleton))
    files.push_back({stem + "-" + std::to_string(files.size() + 1) + ".swc",
                     format_skeleton(part, SkeletonFormat::Swc)});
  return files;
}

std::vector<OutputFile> outputs_of(const ConvertRequest& request, const CurveSkeleton& skeleton) {
  if (request.swc_split) return split_swc(request, skeleton);
  if (request.capsules) return {{request.out, format_capsules(request, skeleton)}};
  const SkeletonFormat format = output_skeleton_format(request.out, request.to);
  return {{request.out, format_skeleton(skeleton, format)}};
}

void run_convert(const ConvertRequest& request) {
  start_clock(request.limits, request.in);
  check_outputs({request.out}, {request.in});
  const InputFile input = read_input(request.in, request.from, request.limits.read);
  const CurveSkeleton skeleton = skeleton_of(input, request.radius);
  write_outputs(outputs_of(request, skeleton));
}

void add_options(CLI::App& verb, ConvertRequest& request) {
  verb.add_option("IN", request.in, "Skeleton; - is standard input")->required()->type_name("");
  verb.add_option("OUT", request.out, "File to write; - is standard output")
      ->required()
      ->type_name("");
  add_format_option(verb, "--from", request.from, "Format of IN, whatever its extension",
                    readable_skeleton_formats());
  std::vector<std::string> outputs = skeleton_formats();
  outputs.insert(outputs.end(), {"stl", "off"});
  add_format_option(verb, "--to", request.to, "Format of OUT, whatever its extension", outputs);
  verb.add_option("--radius", request.radius, "Radius of nodes whose file gives them none")
      ->type_name("R")
      ->check(CLI::PositiveNumber.description(""));
  CLI::Option* capsules =
      verb.add_flag("--capsules", request.capsules,
                    "Balls and cones as a mesh instead of lines: .glb .obj .ply .stl .off");
  verb.add_flag("--swc-split", request.swc_split,
                "A file for every part: OUT-1.swc, OUT-2.swc, ...")
      ->excludes(capsules);
  add_limit_options(verb, request.limits);
}

}  // namespace

void add_convert_command(CLI::App& program) {
  const auto request = std::make_shared<ConvertRequest>();
  CLI::App* verb = program.add_subcommand("convert", "A skeleton in another format");
  add_options(*verb, *request);
  verb->footer(
      "By extension: .skel (of the paper's authors, cinolib), .obj (lines), .ply (edges), .json,\n"
      ".cg (starlab), .graph (GEL), .swc (trees; loops as comments), .polylines.txt (CGAL, no\n"
      "radii), .vtp (ParaView, VMTK), .graphml (networkx, Gephi), .csv; and only written: .dot\n"
      "(Graphviz), .glb. docs/formats.md tells what each of them carries.\n"
      "\n"
      "Examples:\n"
      "  marrow convert horse.skel horse.vtp\n"
      "  marrow convert horse.skel horse.glb --capsules\n"
      "  marrow convert theirs.polylines.txt theirs.skel --radius 0.1\n"
      "  marrow convert - - --from skel --to swc <horse.skel\n");
  verb->callback([request] { run_convert(*request); });
}

}  // namespace marrow
