// marrow render: a shape and its skeleton in one picture.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/volume_surface.hpp>

#include <charconv>
#include <memory>

#include "command.hpp"
#include "limits.hpp"
#include "picture/png.hpp"
#include "picture/render.hpp"
#include "volume_input.hpp"

namespace marrow {

namespace {

struct RenderRequest {
  std::string shape, skeleton, from, out, size = "1600x1200";
  VolumeRequest volume;
  Limits limits;
};

Shape surface_of(const InputFile& input, const VolumeRequest& volume) {
  return is_volume(input) ? boundary_surface(volume_of(input, volume)) : shape_of(input);
}

RenderOptions options_of(const std::string& size) {
  constexpr int kLeast = 64, kMost = 16384;
  RenderOptions options;
  const char* end = size.data() + size.size();
  const auto width = std::from_chars(size.data(), end, options.width);
  const bool has_x = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(has_x ? width.ptr + 1 : end, end, options.height);
  const auto in_range = [](int side) { return side >= kLeast && side <= kMost; };
  if (height.ec != std::errc{} || height.ptr != end || !in_range(options.width) ||
      !in_range(options.height))
    throw Error(ErrorKind::Usage, "--size: " + size + " is not WIDTHxHEIGHT with both " +
                                      std::to_string(kLeast) + " to " + std::to_string(kMost) +
                                      "; see marrow render --help");
  return options;
}

void run_render(const RenderRequest& request) {
  start_clock(request.limits, request.shape);
  const RenderOptions options = options_of(request.size);
  if (request.out != "-" && extension_of(request.out) != "png")
    throw Error(ErrorKind::Unsupported, request.out + ": pictures are .png files");
  if (request.shape == "-" && request.skeleton == "-")
    throw Error(ErrorKind::Usage, "only one of SHAPE and SKELETON can be standard input");
  check_outputs({request.out}, {request.shape, request.skeleton});
  const bool shape_is_named = request.skeleton != "-";
  const auto read = [&](const std::string& path, bool is_named) {
    return read_input(path, is_named ? request.from : "", request.limits.read);
  };
  const Shape shape = surface_of(read(request.shape, shape_is_named), request.volume);
  const CurveSkeleton skeleton = skeleton_of(read(request.skeleton, !shape_is_named));
  write_png(request.out, render_picture(shape, skeleton, options));
}

}  // namespace

void add_render_command(CLI::App& program) {
  const auto request = std::make_shared<RenderRequest>();
  CLI::App* verb = program.add_subcommand("render", "A picture of a shape and its skeleton");
  verb->add_option(
          "SHAPE", request->shape,
          "Shape (.obj .ply .stl .off), point cloud (.xyz .pcd) or volume (.nrrd .nhdr .nii\n"
          ".binvox .raw, .nii.gz .raw.gz), or -")
      ->required()
      ->type_name("");
  verb->add_option("SKELETON", request->skeleton, "Skeleton: all that marrow convert reads, or -")
      ->required()
      ->type_name("");
  verb->add_option("-o,--output", request->out, "The picture: .png, or -")
      ->required()
      ->type_name("FILE");
  add_format_option(*verb, "--from", request->from, "Format of the input that is -, else of SHAPE",
                    input_and_skeleton_formats());
  add_volume_options(*verb, request->volume);
  verb->add_option("--size", request->size, "In pixels, 64 to 16384 each")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  add_limit_options(*verb, request->limits);
  verb->footer(
      "Four views: the shape as an X-ray, the skeleton coloured by radius, joints and leaves\n"
      "marked.\n"
      "\n"
      "Examples:\n"
      "  marrow render horse.obj horse.skel -o horse.png\n"
      "  marrow extract horse.obj -o - --to skel | marrow render horse.obj - --from skel -o a.png "
      "--size 800x600\n");
  verb->callback([request] { run_render(*request); });
}

}  // namespace marrow
