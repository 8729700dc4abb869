// marrow extract: a shape in, its curve-skeleton out.
#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/simd.hpp>

#include <algorithm>
#include <memory>

#include "command.hpp"
#include "extraction.hpp"
#include "limits.hpp"
#include "map_file.hpp"
#include "progress.hpp"
#include "statistics.hpp"
#include "trace.hpp"

namespace marrow {

namespace {

struct ExtractRequest {
  std::string shape, from, out, to, json, map, trace;
  ExtractionRequest extraction;
  Limits limits;
  bool quiet = false;
};

/// All that is not under "run" is the same for the same input, options and version.
Statistics describe(const ExtractRequest& request, const Statistics& input,
                    const CurveSkeleton& skeleton, const std::vector<StageTime>& times) {
  Statistics s;
  s["program"] = "marrow";
  s["version"] = program_version();
  s["input"] = input;
  s["options"] = describe(request.extraction, input.contains("voxels"));
  s["skeleton"] = statistics_of(skeleton);
  s["run"]["threads"] = request.extraction.threads;
  double total = 0;
  for (const auto& [stage, seconds] : times) {
    s["run"]["seconds"][stage] = seconds;
    total += seconds;
  }
  s["run"]["total_seconds"] = total;
  return s;
}

/// The library knows no file names.
[[noreturn]] void throw_with_name(const InputFile& input, const Error& e) {
  throw Error(e.kind(), input.name + ": " + e.what());
}

struct Extraction {
  CurveSkeleton skeleton;
  std::vector<OutputFile> trace;
};

template <class Input>
Extraction run_stages(const ExtractRequest& request, const InputFile& input, const Input& shape,
                      Progress& progress) {
  ExtractOptions options = options_of(request.extraction);
  options.on_stage = [&](std::string_view stage, double done) {
    if (done < 1) progress.begin(stage, done);
  };
  try {
    if (request.trace.empty()) return {extract(shape, options), {}};
    ExtractTrace trace = extract_with_trace(shape, options);
    progress.begin("trace", 1);
    std::vector<OutputFile> files = draw_trace(trace, request.trace);
    return {std::move(trace.skeleton), std::move(files)};
  } catch (const Error& e) {
    throw_with_name(input, e);
  }
}

void say_what_is_there(const ExtractRequest& request, const InputFile& input,
                       const CurveSkeleton& skeleton, const std::vector<StageTime>& times) {
  double seconds = 0;
  for (const StageTime& time : times) seconds += time.seconds;
  std::fprintf(stderr,
               "%s -> %s: components %d, cycles %d, leaves %d, joints %d, nodes %zu; %.2f s\n",
               one_line(input.name).c_str(), one_line(request.out).c_str(),
               component_count(skeleton), cycle_count(skeleton), leaf_count(skeleton),
               joint_count(skeleton), skeleton.nodes.size(), seconds);
}

void warn_of_lost_nodes(const CurveSkeleton& skeleton, SkeletonFormat format) {
  const std::vector<int> degree = degrees(skeleton);
  const auto alone = std::count(degree.begin(), degree.end(), 0);
  if (format == SkeletonFormat::Skel && alone > 0)
    warn("nodes without an edge: " + std::to_string(alone) +
         "; other programs drop them when they read a .skel file");
}

void check_request(const ExtractRequest& request) {
  std::vector<std::string> outputs{request.out};
  if (!request.json.empty()) outputs.push_back(request.json);
  if (!request.map.empty()) outputs.push_back(request.map);
  check_outputs(outputs, {request.shape});
  if (!request.trace.empty()) check_folder(request.trace);
}

void run_extract(const ExtractRequest& request) {
  start_clock(request.limits, request.shape);
  check_request(request);
  set_simd_target(request.extraction.simd);
  const SkeletonFormat format = output_skeleton_format(request.out, request.to);
  const bool with_map = !request.map.empty();
  const MapFormat map_format = with_map ? map_format_of(request.map) : MapFormat::Csv;
  Progress progress(request.quiet);
  progress.begin("read", 0);
  InputFile input = read_input(request.shape, request.from, request.limits.read);
  const auto shape = shape_or_volume_of(input, request.extraction.volume);
  const bool with_json = !request.json.empty();
  Statistics about_input;
  if (with_json) {
    about_input = describe(input);
    about_input.update(describe_size(shape));
  }
  std::string().swap(input.bytes);  // as large as the shape
  Extraction extraction =
      std::visit([&](const auto& any) { return run_stages(request, input, any, progress); }, shape);
  const CurveSkeleton skeleton = kept_parts(request.extraction, std::move(extraction.skeleton));
  std::vector<OutputFile> files = std::move(extraction.trace);
  if (with_map) {
    progress.begin("map", 1);
    files.push_back({request.map, map_file(shape, skeleton, map_format)});
  }
  const std::vector<StageTime> times = progress.finish();
  if (with_json)
    files.push_back({request.json, to_json(describe(request, about_input, skeleton, times))});
  files.push_back({request.out, format_skeleton(skeleton, format)});
  write_outputs(files, request.trace);
  if (request.quiet) return;
  warn_of_lost_nodes(skeleton, format);
  say_what_is_there(request, input, skeleton, times);
}

void add_options(CLI::App& verb, ExtractRequest& request) {
  verb.add_option(
          "SHAPE", request.shape,
          "Shape (.obj .ply .stl .off), point cloud (.xyz .pts .txt .asc .csv .pcd and .ply .off\n"
          ".obj without faces) or volume (.nrrd .nhdr .nii .binvox .raw, .nii.gz .raw.gz);\n"
          "- is standard input")
      ->required()
      ->type_name("");
  verb.add_option(
          "-o,--output", request.out,
          "File for the skeleton: .skel .obj .ply .json .vtp .swc .graphml and others, see\n"
          "marrow convert --help; - is standard output")
      ->required()
      ->type_name("OUT");
  add_format_option(verb, "--from", request.from, "Format of SHAPE, whatever its extension",
                    input_formats());
  add_format_option(verb, "--to", request.to, "Format of the output, whatever its extension",
                    skeleton_formats());
  add_extraction_options(verb, request.extraction);
  verb.add_option("--json", request.json,
                  "File for counts, options and times; - is standard output")
      ->type_name("FILE");
  verb.add_option(
          "--map", request.map,
          "File for the node, branch and part of every point or voxel of SHAPE: .csv .json,\n"
          "or .ply, which is coloured by branch")
      ->type_name("FILE");
  verb.add_option("--trace", request.trace, "Folder for pictures and graphs of every stage")
      ->type_name("DIR");
  verb.add_flag("--quiet", request.quiet, "Say nothing but errors");
  add_limit_options(verb, request.limits);
}

}  // namespace

void add_extract_command(CLI::App& program) {
  const auto request = std::make_shared<ExtractRequest>();
  CLI::App* verb = program.add_subcommand("extract", "The curve-skeleton of a shape");
  add_options(*verb, *request);
  verb->footer(
      "Positions and radii are in the units of the shape. Any triangle soup will do: open, in\n"
      "parts, with holes or flipped faces; and any point cloud, without normals. Where\n"
      "marrow-import is installed, shapes are also read from .gltf .glb .fbx .dae .3ds .x3d\n"
      "and .3mf files.\n"
      "\n"
      "Examples:\n"
      "  marrow extract horse.obj -o horse.skel\n"
      "  marrow extract tiny_parts.stl -o out.json --image 1024 --json -\n"
      "  marrow extract lost_limb.ply -o out.obj --trace stages/\n"
      "  marrow extract vessels.nii.gz -o vessels.skel --iso 120\n"
      "  unzip -p horse.zip | marrow extract - --from ply -o - --to obj | marrow info - --from "
      "obj\n");
  verb->callback([request] { run_extract(*request); });
}

}  // namespace marrow
