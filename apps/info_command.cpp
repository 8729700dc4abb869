// marrow info: what is in a file.
#include <marrow/file_io.hpp>

#include <memory>

#include "command.hpp"
#include "limits.hpp"
#include "statistics.hpp"
#include "volume_input.hpp"

namespace marrow {

namespace {

struct InfoRequest {
  std::string file, from;
  VolumeRequest volume;
  Limits limits;
  bool json = false;
};

Statistics statistics_of_file(const InputFile& input, const VolumeRequest& volume) {
  if (is_skeleton(input)) return statistics_of(skeleton_of(input));
  return std::visit([](const auto& shape) { return statistics_of(shape); },
                    shape_or_volume_of(input, volume));
}

void run_info(const InfoRequest& request) {
  start_clock(request.limits, request.file);
  const InputFile input = read_input(request.file, request.from, request.limits.read);
  Statistics statistics;
  statistics["file"] = input.name;
  statistics.update(statistics_of_file(input, request.volume));
  write_file("-", request.json ? to_json(statistics) : to_table(statistics));
}

}  // namespace

void add_info_command(CLI::App& program) {
  const auto request = std::make_shared<InfoRequest>();
  CLI::App* verb = program.add_subcommand("info", "Counts and measures of a shape or a skeleton");
  verb->add_option(
          "FILE", request->file,
          "Shape (.obj .ply .stl .off), point cloud (.xyz .pts .txt .asc .csv .pcd .ply), volume\n"
          "(.nrrd .nhdr .nii .binvox .raw, .nii.gz .raw.gz) or skeleton (all that marrow convert\n"
          "reads); - is standard input")
      ->required()
      ->type_name("");
  add_format_option(*verb, "--from", request->from, "Format of FILE, whatever its extension",
                    input_and_skeleton_formats());
  add_volume_options(*verb, request->volume);
  verb->add_flag("--json", request->json, "JSON instead of a table");
  add_limit_options(*verb, request->limits);
  verb->footer(
      "An OBJ with lines and no faces, or a PLY with edges and no faces, is a skeleton.\n"
      "Points at the same place count as one when parts and open edges are counted.\n"
      "\n"
      "Examples:\n"
      "  marrow info horse.obj\n"
      "  marrow info horse.skel --json\n"
      "  marrow info head.nii.gz --iso 300\n"
      "  marrow extract horse.obj -o - --to obj | marrow info - --from obj\n");
  verb->callback([request] { run_info(*request); });
}

}  // namespace marrow
