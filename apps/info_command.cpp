// marrow info: what is in a file.
#include <marrow/file_io.hpp>

#include <memory>

#include "command.hpp"
#include "statistics.hpp"

namespace marrow {

namespace {

struct InfoRequest {
  std::string file, from;
  bool json = false;
};

void run_info(const InfoRequest& request) {
  const InputFile input = read_input(request.file, request.from);
  Statistics statistics;
  statistics["file"] = input.name;
  statistics.update(is_skeleton(input) ? statistics_of(skeleton_of(input))
                                       : statistics_of(shape_of(input)));
  write_file("-", request.json ? to_json(statistics) : to_table(statistics));
}

}  // namespace

void add_info_command(CLI::App& program) {
  const auto request = std::make_shared<InfoRequest>();
  CLI::App* verb = program.add_subcommand("info", "Counts and measures of a shape or a skeleton");
  verb->add_option(
          "FILE", request->file,
          "Shape (.obj .ply .stl .off), point cloud (.xyz .pts .txt .asc .csv .pcd .ply) or\n"
          "skeleton (.obj .skel .ply .json); - is standard input")
      ->required()
      ->type_name("");
  add_format_option(*verb, "--from", request->from, "Format of FILE, whatever its extension",
                    {"obj", "ply", "stl", "off", "xyz", "pcd", "skel", "json"});
  verb->add_flag("--json", request->json, "JSON instead of a table");
  verb->footer(
      "An OBJ with lines and no faces, or a PLY with edges and no faces, is a skeleton.\n"
      "Points at the same place count as one when parts and open edges are counted.\n"
      "\n"
      "Examples:\n"
      "  marrow info horse.obj\n"
      "  marrow info horse.skel --json\n"
      "  marrow extract horse.obj -o - --to obj | marrow info - --from obj\n");
  verb->callback([request] { run_info(*request); });
}

}  // namespace marrow
