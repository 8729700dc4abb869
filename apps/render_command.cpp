// marrow render: shapes and their skeletons in one picture.
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/volume_surface.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>

#include "command.hpp"
#include "limits.hpp"
#include "picture/png.hpp"
#include "picture/render.hpp"
#include "picture/stage_images.hpp"
#include "volume_input.hpp"

namespace marrow {

namespace {

constexpr std::array<std::string_view, 5> kViews = {"front", "side", "top", "three-quarter", "all"};
constexpr std::size_t kMostPictures = 500;  ///< on a sheet

struct RenderRequest {
  std::vector<std::string> files;
  std::string from, out, size, view, background = "white";
  bool sheet = false;
  VolumeRequest volume;
  Limits limits;
};

/// What one picture shows.
struct Subject {
  std::string name;  ///< of its first file
  Shape shape;
  CurveSkeleton skeleton;
};

void set_size(const std::string& size, RenderOptions& options) {
  constexpr int kLeast = 64, kMost = 16384;
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
}

Colour colour_of(const std::string& name) {
  if (name == "white") return {1, 1, 1};
  if (name == "black") return {0, 0, 0};
  unsigned value = 0;
  const char* end = name.data() + name.size();
  const bool is_hex = name.size() == 7 && name[0] == '#';
  const auto parsed = std::from_chars(name.data() + (is_hex ? 1 : 0), end, value, 16);
  if (!is_hex || parsed.ec != std::errc{} || parsed.ptr != end)
    throw Error(ErrorKind::Usage, "--background: " + name +
                                      " is not white, black or #rrggbb; see marrow render --help");
  return from_bytes(static_cast<int>(value >> 16), static_cast<int>(value >> 8 & 255),
                    static_cast<int>(value & 255));
}

RenderOptions options_of(const RenderRequest& request) {
  RenderOptions options;
  const char* size = request.sheet ? "320x240" : "1600x1200";
  set_size(request.size.empty() ? size : request.size, options);
  const std::string view = request.view.empty() ? (request.sheet ? "front" : "all") : request.view;
  const auto found = std::find(kViews.begin(), kViews.end(), view);
  options.view = static_cast<ViewChoice>(found - kViews.begin());
  options.background = colour_of(request.background);
  options.legend = !request.sheet;
  return options;
}

/// The files as they are named; --from is for the one that is standard input, else for the first.
InputFile read(const RenderRequest& request, std::size_t i) {
  const auto& files = request.files;
  const auto pipe = std::find(files.begin(), files.end(), "-");
  const bool is_named = pipe == files.end() ? i == 0 : files[i] == "-";
  return read_input(files[i], is_named ? request.from : "", request.limits.read);
}

Shape surface_of(const InputFile& input, const VolumeRequest& volume) {
  return is_volume(input) ? boundary_surface(volume_of(input, volume)) : shape_of(input);
}

/// One file, or a shape and its skeleton.
Subject single_subject(const RenderRequest& request) {
  const InputFile first = read(request, 0);
  if (request.files.size() == 1 && is_skeleton(first)) return {first.name, {}, skeleton_of(first)};
  Subject subject{first.name, surface_of(first, request.volume), {}};
  if (request.files.size() == 2) subject.skeleton = skeleton_of(read(request, 1));
  return subject;
}

/// A picture for every shape, with the skeleton that follows it, and for every other skeleton.
std::vector<LabelledImage> draw_all(const RenderRequest& request, const RenderOptions& options) {
  std::vector<LabelledImage> images;
  Subject subject;
  const auto draw = [&] {
    if (subject.name.empty()) return;
    images.push_back({std::filesystem::path(subject.name).stem().string(),
                      render_picture(subject.shape, subject.skeleton, options)});
    subject = {};
  };
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    const InputFile input = read(request, i);
    if (is_skeleton(input)) {
      if (subject.shape.points.empty()) subject.name = input.name;
      subject.skeleton = skeleton_of(input);
      draw();
    } else {
      draw();
      subject = {input.name, surface_of(input, request.volume), {}};
    }
  }
  draw();
  return images;
}

void check_request(const RenderRequest& request, bool is_svg) {
  const std::string extension = request.out == "-" ? "png" : extension_of(request.out);
  if (extension != "png" && extension != "svg")
    throw Error(ErrorKind::Unsupported, request.out + ": pictures are .png or .svg files");
  if (is_svg && request.sheet)
    throw Error(ErrorKind::Unsupported, request.out + ": a sheet is a .png file");
  if (std::count(request.files.begin(), request.files.end(), "-") > 1)
    throw Error(ErrorKind::Usage, "only one of the files can be standard input");
  if (!request.sheet && request.files.size() > 2)
    throw Error(ErrorKind::Usage,
                "a picture is of a shape and its skeleton; for more files say --sheet");
  if (request.files.size() > 2 * kMostPictures)
    throw Error(ErrorKind::Usage,
                "a sheet is of " + std::to_string(kMostPictures) + " pictures at most");
  check_outputs({request.out}, request.files);
}

void run_render(const RenderRequest& request) {
  start_clock(request.limits, request.files.front());
  const bool is_svg = extension_of(request.out) == "svg";
  const RenderOptions options = options_of(request);
  check_request(request, is_svg);
  if (request.sheet) return write_png(request.out, contact_sheet(draw_all(request, options)));
  const Subject subject = single_subject(request);
  if (is_svg)
    write_file(request.out, render_svg(subject.shape, subject.skeleton, options));
  else
    write_png(request.out, render_picture(subject.shape, subject.skeleton, options));
}

void add_options(CLI::App& verb, RenderRequest& request) {
  verb.add_option("FILES", request.files,
                  "A shape (.obj .ply .stl .off), point cloud (.xyz .pcd) or volume (.nrrd .nhdr\n"
                  ".nii .binvox .raw, .nii.gz .raw.gz), its skeleton (all that marrow convert\n"
                  "reads), or both in this order; - is standard input")
      ->required()
      ->type_name("");
  verb.add_option("-o,--output", request.out, "The picture: .png, .svg for lines, or - (PNG)")
      ->required()
      ->type_name("FILE");
  add_format_option(verb, "--from", request.from,
                    "Format of the input that is -, else of the first",
                    input_and_skeleton_formats());
  add_volume_options(verb, request.volume);
  verb.add_option(
          "--size", request.size,
          "In pixels, 64 to 16384 each: 1600x1200 if nothing is said, on a sheet 320x240 for\n"
          "each picture")
      ->type_name("WIDTHxHEIGHT");
  add_format_option(verb, "--view", request.view,
                    "Where to look from: all if nothing is said, front on a sheet",
                    {kViews.begin(), kViews.end()});
  verb.add_option("--background", request.background, "white, black or #rrggbb")
      ->type_name("COLOUR")
      ->capture_default_str();
  verb.add_flag(
      "--sheet", request.sheet,
      "Many pictures in one: of every shape, with the skeleton that follows it if one does");
  add_limit_options(verb, request.limits);
}

}  // namespace

void add_render_command(CLI::App& program) {
  const auto request = std::make_shared<RenderRequest>();
  CLI::App* verb = program.add_subcommand("render", "A picture of a shape and its skeleton");
  add_options(*verb, *request);
  verb->footer(
      "The shape as an X-ray, the skeleton coloured by radius, joints and leaves marked, from "
      "four\n"
      "sides. In an SVG the balls of the skeleton stand for the shape.\n"
      "\n"
      "Examples:\n"
      "  marrow render horse.obj horse.skel -o horse.png\n"
      "  marrow render horse.skel -o horse.svg --view three-quarter\n"
      "  marrow render --sheet horse.obj horse.skel hand.obj hand.skel -o sheet.png\n"
      "  marrow extract horse.obj -o - --to skel | marrow render horse.obj - --from skel -o a.png "
      "--size 800x600\n");
  verb->callback([request] { run_render(*request); });
}

}  // namespace marrow
