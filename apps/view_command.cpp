// marrow view: a page to look at a shape and its skeleton in a browser.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/volume_surface.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "pair_input.hpp"
#include "viewer/view_page.hpp"

namespace marrow {

namespace {

namespace fs = std::filesystem;

struct ViewRequest {
  PairRequest pair;
  std::string out, title, trace;
};

Shape surface_of(const InputFile& input, const VolumeRequest& volume) {
  return is_volume(input) ? boundary_surface(volume_of(input, volume)) : shape_of(input);
}

/// "stages/06_tree.obj" -> "tree".
std::string stage_of(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t digits = stem.find_first_not_of("0123456789_");
  return digits == std::string::npos ? stem : stem.substr(digits);
}

/// The graphs in a folder that --trace has written, in their order, but for the skeleton itself.
std::vector<ViewLines> stages_in(const std::string& folder, const ReadOptions& limits) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (extension_of(at->path().string()) == "obj") paths.push_back(at->path());
  if (error) throw Error(ErrorKind::CannotRead, folder + ": cannot be read: " + error.message());
  std::sort(paths.begin(), paths.end());
  std::vector<ViewLines> stages;
  for (const fs::path& path : paths) {
    const InputFile file = read_input(path.string(), "", limits);
    if (is_skeleton(file) && stage_of(path) != "skeleton")
      stages.push_back({stage_of(path), skeleton_of(file)});
  }
  if (stages.empty())
    throw Error(ErrorKind::Empty,
                folder +
                    ": no graph of a stage is in it; name a folder that marrow extract --trace "
                    "has written");
  return stages;
}

void check_request(const ViewRequest& request) {
  const std::string extension = extension_of(request.out);
  if (request.out != "-" && extension != "html" && extension != "htm")
    throw Error(ErrorKind::Unsupported, request.out + ": pages are .html files");
  check_outputs({request.out}, {request.pair.shape, request.pair.skeleton});
}

std::string title_of(const ViewRequest& request) {
  if (!request.title.empty()) return request.title;
  const std::string& named = request.pair.shape != "-" ? request.pair.shape : request.pair.skeleton;
  return fs::path(named).filename().string();
}

void run_view(const ViewRequest& request) {
  start_clock(request.pair);
  check_request(request);
  ViewContent content;
  content.title = title_of(request);
  content.shape = surface_of(read_shape_of(request.pair), request.pair.volume);
  content.lines.push_back({"skeleton", skeleton_of(read_skeleton_of(request.pair))});
  if (!request.trace.empty())
    for (ViewLines& stage : stages_in(request.trace, request.pair.limits.read))
      content.lines.push_back(std::move(stage));
  write_outputs({{request.out, view_page(content)}});
}

}  // namespace

void add_view_command(CLI::App& program) {
  const auto request = std::make_shared<ViewRequest>();
  CLI::App* verb = program.add_subcommand("view", "A page to look at a shape and its skeleton");
  verb->add_option("-o,--output", request->out, "The page: .html, or -")
      ->required()
      ->type_name("FILE");
  verb->add_option("--title", request->title, "Title of the page; by default the name of SHAPE")
      ->type_name("WORDS");
  verb->add_option("--trace", request->trace,
                   "Folder that marrow extract --trace has written: its graphs become layers")
      ->type_name("DIR");
  add_pair_options(*verb, request->pair);
  verb->footer(
      "One file that loads nothing and works offline, in any browser with WebGL 2. Shapes of\n"
      "more than about 100,000 triangles are shown coarser.\n"
      "\n"
      "Examples:\n"
      "  marrow view horse.obj horse.skel -o horse.html\n"
      "  marrow extract horse.obj -o horse.skel --trace stages/\n"
      "  marrow view horse.obj horse.skel -o horse.html --trace stages/\n");
  verb->callback([request] { run_view(*request); });
}

}  // namespace marrow
