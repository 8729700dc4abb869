#include "extraction.hpp"

#include <marrow/directions_io.hpp>
#include <marrow/parts.hpp>
#include <marrow/volume_summary.hpp>

#include "hash.hpp"

namespace marrow {

namespace {

void add_size(Statistics& s, const Shape& shape) {
  s["points"] = shape.points.size();
  s["triangles"] = shape.triangles.size();
}

void add_size(Statistics& s, const Volume& volume) {
  s["voxels"] = {volume.nx, volume.ny, volume.nz};
  s["foreground"] = foreground_count(volume);
}

}  // namespace

void add_extraction_options(CLI::App& verb, ExtractionRequest& request) {
  add_volume_options(verb, request.volume);
  verb.add_option("--image", request.image,
                  "Pixels along a side of each silhouette; by default 256, and 512 where parts\n"
                  "are thinner than a pixel")
      ->check(CLI::Range(64, 1024).description(""))
      ->type_name("64..1024");
  verb.add_option("--closing", request.closing,
                  "Point clouds: radius in pixels that gaps between points are closed by; by\n"
                  "default it follows the density of the points")
      ->check(CLI::Range(0.0, 24.0).description(""))
      ->type_name("0..24");
  verb.add_option("--grid", request.grid,
                  "Voxels along the longest side of the shape; thin parts get up to 192")
      ->check(CLI::Range(16, 256).description(""))
      ->type_name("16..256")
      ->capture_default_str();
  verb.add_option("--silhouettes", request.silhouettes,
                  "Fill silhouettes in exact integers, or by rays (border pixels differ)")
      ->check(CLI::IsMember({"scanline", "embree"}).description(""))
      ->type_name("scanline|embree")
      ->capture_default_str();
  verb.add_option(
          "--rules", request.rules,
          "Marrow's rules, or the paper's own, to compare with: false loops and spurs stay,\n"
          "and nothing is refined")
      ->check(CLI::IsMember({"marrow", "paper"}).description(""))
      ->type_name("marrow|paper")
      ->capture_default_str();
  verb.add_option("--refine", request.refine,
                  "End with the paper's smoothing and radii of matches, with radii of the visual\n"
                  "hull, or with lines and radii put right on the surface; clouds and volumes\n"
                  "end with the hull")
      ->check(CLI::IsMember({"none", "hull", "surface"}).description(""))
      ->type_name("none|hull|surface")
      ->capture_default_str();
  verb.add_option_function<std::string>(
          "--views",
          [&request](const std::string& views) {
            request.views = views;
            request.directions.clear();
            if (views != "21" && views != "81") request.directions = read_directions(views);
          },
          "Directions to look along: 21, 81 (three to four times the work), or those of a text\n"
          "file, one 'x y z' a line in the coordinates of the shape, 1 to 1024")
      ->type_name("21|81|FILE")
      ->default_str(request.views);
  const auto largest =
      verb.add_flag("--largest", request.largest, "Keep only the part with the longest lines");
  verb.add_option("--min-part", request.min_part,
                  "Drop parts whose lines are shorter than this share of the longest part's")
      ->check(CLI::Range(0.0, 100.0).description(""))
      ->type_name("PERCENT")
      ->excludes(largest);
  verb.add_option("--threads", request.threads,
                  "Threads at most, 0 for all; the result does not depend on it")
      ->check(CLI::Range(0, 1024).description(""))
      ->type_name("0..1024")
      ->capture_default_str();
  verb.add_option("--simd", request.simd,
                  "Instruction set in place of the best one; the result does not depend on it")
      ->type_name("NAME");
}

ExtractOptions options_of(const ExtractionRequest& request) {
  ExtractOptions options;
  options.image_resolution = request.image;
  options.closing = request.closing;
  options.grid_resolution = request.grid;
  if (request.silhouettes == "embree") options.silhouettes = SilhouetteMethod::Embree;
  if (request.rules == "paper") options.rules = Rules::Paper;
  if (request.refine == "none") options.refinement = Refinement::None;
  if (request.refine == "hull") options.refinement = Refinement::Hull;
  if (request.views == "81") options.views = 81;
  options.directions = request.directions;
  options.max_threads = request.threads;
  return options;
}

CurveSkeleton kept_parts(const ExtractionRequest& request, CurveSkeleton skeleton) {
  if (request.largest) return largest_part(skeleton);
  if (request.min_part > 0) return large_parts(skeleton, request.min_part / 100);
  return skeleton;
}

Statistics describe(const ExtractionRequest& request, bool is_volume) {
  Statistics s;
  if (is_volume) s["iso"] = request.volume.iso;
  s["image"] = request.image;
  s["grid"] = request.grid;
  s["closing"] = request.closing;
  s["silhouettes"] = request.silhouettes;
  s["rules"] = request.rules;
  s["refine"] = request.rules == "paper" ? "none" : request.refine;
  s["views"] = request.directions.empty() ? std::stoi(request.views)
                                          : static_cast<int>(request.directions.size());
  for (const Vec3& d : request.directions) s["directions"].push_back({d.x, d.y, d.z});
  s["largest"] = request.largest;
  s["min_part"] = request.min_part;
  return s;
}

Statistics describe(const InputFile& input) {
  Statistics s;
  s["file"] = input.name;
  s["format"] = input.format;
  s["bytes"] = input.bytes.size();
  s["hash"] = hash_of(input.bytes);
  return s;
}

Statistics describe_size(const std::variant<Shape, Volume>& shape) {
  Statistics s;
  std::visit([&](const auto& any) { add_size(s, any); }, shape);
  return s;
}

}  // namespace marrow
