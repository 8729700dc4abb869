// marrow convert: a curve-skeleton from one format into another.
#include <marrow/capsule_mesh.hpp>
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/parts.hpp>
#include <marrow/prune.hpp>
#include <marrow/resample.hpp>
#include <marrow/simplify.hpp>

#include <memory>

#include "command.hpp"
#include "limits.hpp"

namespace marrow {

namespace {

struct ConvertRequest {
  std::string in, out, from, to;
  double radius = 0;  ///< of nodes that have none
  bool largest = false;
  double min_part = 0;  ///< percent
  PruneOptions prune;
  double simplify = 0, spacing = 0, spacing_by_radius = 0;  ///< 0: not asked for
  bool capsules = false, swc_split = false;
  Limits limits;
};

/// What is asked for, in this order.
CurveSkeleton edited(const ConvertRequest& request, CurveSkeleton skeleton) {
  if (request.largest) skeleton = largest_part(skeleton);
  if (request.min_part > 0) skeleton = large_parts(skeleton, request.min_part / 100);
  if (request.prune.length > 0 || request.prune.radius > 0)
    skeleton = prune(skeleton, request.prune);
  if (request.simplify > 0) skeleton = simplify(skeleton, request.simplify);
  if (request.spacing > 0) skeleton = resample(skeleton, request.spacing);
  if (request.spacing_by_radius > 0)
    skeleton = resample_by_radius(skeleton, request.spacing_by_radius);
  return skeleton;
}

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
  const CurveSkeleton skeleton = edited(request, skeleton_of(input, request.radius));
  const std::vector<OutputFile> files = outputs_of(request, skeleton);
  std::vector<std::string> paths;
  for (const OutputFile& file : files) paths.push_back(file.path);
  check_outputs(paths, {request.in});  // one for every part may have another name
  write_outputs(files);
}

constexpr const char* kEdits = "Edits, in this order; lengths are in the units of the skeleton";

CLI::Option* add_measure(CLI::App& verb, const std::string& name, double& value,
                         const std::string& words, const std::string& type) {
  return verb.add_option(name, value, words)
      ->type_name(type)
      ->check(CLI::PositiveNumber.description(""))
      ->group(kEdits);
}

void add_edits(CLI::App& verb, ConvertRequest& request) {
  CLI::Option* largest =
      verb.add_flag("--largest", request.largest, "Keep only the part with the longest lines");
  largest->group(kEdits);
  add_measure(verb, "--min-part", request.min_part,
              "Keep only parts of at least this share of the longest", "PERCENT")
      ->excludes(largest);
  add_measure(verb, "--prune-length", request.prune.length, "Take off end branches shorter than L",
              "L");
  add_measure(verb, "--prune-radius", request.prune.radius,
              "Take off end branches whose mean radius is below R", "R");
  CLI::Option* simplify =
      add_measure(verb, "--simplify", request.simplify,
                  "Take out nodes as long as lines and radii stay within T", "T");
  CLI::Option* spacing = add_measure(verb, "--spacing", request.spacing,
                                     "Nodes along every branch in equal steps of about S", "S");
  add_measure(verb, "--spacing-by-radius", request.spacing_by_radius,
              "The same in steps of K times the radius", "K")
      ->excludes(spacing)
      ->excludes(simplify);
  spacing->excludes(simplify);
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
  add_edits(verb, request);
  add_limit_options(verb, request.limits);
}

}  // namespace

void add_convert_command(CLI::App& program) {
  const auto request = std::make_shared<ConvertRequest>();
  CLI::App* verb =
      program.add_subcommand("convert", "A skeleton in another format, pruned or resampled");
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
      "  marrow convert horse.skel smooth.swc --prune-length 0.05 --spacing 0.01\n"
      "  marrow convert - - --from skel --to swc <horse.skel\n");
  verb->callback([request] { run_convert(*request); });
}

}  // namespace marrow
