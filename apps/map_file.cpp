#include "map_file.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/rig.hpp>

#include <array>
#include <bit>
#include <charconv>

#include "picture/colour_map.hpp"

namespace marrow {

namespace {

void append_number(std::string& text, std::uint64_t number) {
  char digits[24];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// Little-endian, whatever the machine.
template <class Integer>
void append_bytes(std::string& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

using Cell = std::array<int, 3>;

std::vector<Cell> foreground_of(const Volume& volume) {
  std::vector<Cell> cells;
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x)
        if (volume(x, y, z)) cells.push_back({x, y, z});
  return cells;
}

/// What a file says in front of every place.
class Sites {
 public:
  explicit Sites(const Shape&) {}
  explicit Sites(const Volume& volume) : volume_(&volume), cells_(foreground_of(volume)) {}

  bool are_voxels() const { return volume_ != nullptr; }
  const char* csv_names() const { return volume_ ? "x,y,z" : "point"; }
  void append_csv(std::string& text, std::size_t i) const {
    if (!volume_) return append_number(text, i);
    const char* between = "";
    for (const int side : cells_[i]) {
      text += between;
      append_number(text, static_cast<std::uint64_t>(side));
      between = ",";
    }
  }
  std::uint64_t index(std::size_t i) const {
    const auto [x, y, z] = cells_[i];
    const auto nx = static_cast<std::uint64_t>(volume_->nx);
    const auto ny = static_cast<std::uint64_t>(volume_->ny);
    return static_cast<std::uint64_t>(x) +
           nx * (static_cast<std::uint64_t>(y) + ny * static_cast<std::uint64_t>(z));
  }
  std::vector<Vec3> middles() const {
    std::vector<Vec3> points;
    points.reserve(cells_.size());
    for (const auto& [x, y, z] : cells_)
      points.push_back(volume_->to_world({double(x), double(y), double(z)}));
    return points;
  }

 private:
  const Volume* volume_ = nullptr;
  std::vector<Cell> cells_;
};

std::string format_csv(const SurfaceMap& map, const Sites& sites) {
  std::string text = std::string(sites.csv_names()) + ",node,branch,part\n";
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    sites.append_csv(text, i);
    for (const std::uint32_t number :
         {map.places[i].node, map.places[i].branch, map.places[i].part}) {
      text += ',';
      append_number(text, number);
    }
    text += '\n';
  }
  return text;
}

/// `[number(0),number(1),...]`.
template <class Number>
void append_list(std::string& text, std::size_t count, const Number& number) {
  text += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    append_number(text, number(i));
  }
  text += ']';
}

std::string format_json(const SurfaceMap& map, const Sites& sites, const Volume* volume) {
  const std::size_t count = map.places.size();
  std::string text = "{\"format\": \"marrow-map\", \"version\": 1, \"of\": ";
  text += volume ? "\"voxels\"" : "\"points\"";
  text += ", \"parts\": " + std::to_string(map.part_count) + ",\n\"branches\": [";
  for (std::size_t b = 0; b < map.branches.size(); ++b) {
    if (b > 0) text += ",\n";
    const auto& nodes = map.branches[b].nodes;
    append_list(text, nodes.size(), [&](std::size_t i) { return nodes[i]; });
  }
  text += ']';
  const auto add = [&](const char* name, const auto& number) {
    text += std::string(",\n\"") + name + "\": ";
    append_list(text, count, number);
  };
  if (volume) {
    const std::array sides{volume->nx, volume->ny, volume->nz};
    text += ",\n\"voxels\": ";
    append_list(text, 3, [&](std::size_t i) { return static_cast<std::uint64_t>(sides[i]); });
    add("index", [&](std::size_t i) { return sites.index(i); });
  }
  add("node", [&](std::size_t i) { return map.places[i].node; });
  add("branch", [&](std::size_t i) { return map.places[i].branch; });
  add("part", [&](std::size_t i) { return map.places[i].part; });
  return text + "}\n";
}

std::string format_ply(const SurfaceMap& map, const std::vector<Vec3>& points,
                       const std::vector<Triangle>& triangles) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment marrow surface map\n";
  bytes += "element vertex " + std::to_string(points.size()) + "\n";
  for (const char* name : {"double x", "double y", "double z", "uchar red", "uchar green",
                           "uchar blue", "uint node", "uint branch", "uint part"})
    bytes += std::string("property ") + name + "\n";
  if (!triangles.empty())
    bytes += "element face " + std::to_string(triangles.size()) +
             "\nproperty list uchar uint vertex_indices\n";
  bytes += "end_header\n";
  bytes.reserve(bytes.size() + 39 * points.size() + 13 * triangles.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceMap::Place& place = map.places[i];
    for (const double c : {points[i].x, points[i].y, points[i].z})
      append_bytes(bytes, std::bit_cast<std::uint64_t>(c));
    const Colour colour = branch_colour(place.branch);
    for (const float c : {colour.r, colour.g, colour.b}) append_bytes(bytes, to_byte(c));
    for (const std::uint32_t n : {place.node, place.branch, place.part}) append_bytes(bytes, n);
  }
  for (const Triangle& t : triangles) {
    bytes.push_back(3);
    for (const std::uint32_t corner : t) append_bytes(bytes, corner);
  }
  return bytes;
}

std::string format_ply(const SurfaceMap& map, const Shape& shape, const Sites&) {
  return format_ply(map, shape.points, shape.triangles);
}

std::string format_ply(const SurfaceMap& map, const Volume&, const Sites& sites) {
  return format_ply(map, sites.middles(), {});
}

std::string format_rig(const SurfaceMap& map, const Shape& shape, const CurveSkeleton& skeleton) {
  return format_rig_glb(shape, skeleton, map);
}

std::string format_rig(const SurfaceMap&, const Volume&, const CurveSkeleton&) {
  throw Error(ErrorKind::Unsupported,
              "a .glb is of a mesh; the map of a volume is .csv, .json or .ply");
}

const Volume* volume_in(const Volume& volume) { return &volume; }
const Volume* volume_in(const Shape&) { return nullptr; }

template <class Input>
std::string map_file_of(const Input& input, const CurveSkeleton& skeleton, MapFormat format) {
  const SurfaceMap map = map_surface(input, skeleton);
  const Sites sites(input);
  if (format == MapFormat::Csv) return format_csv(map, sites);
  if (format == MapFormat::Json) return format_json(map, sites, volume_in(input));
  if (format == MapFormat::Glb) return format_rig(map, input, skeleton);
  return format_ply(map, input, sites);
}

}  // namespace

MapFormat map_format_of(const std::string& path) {
  if (path == "-")
    throw Error(ErrorKind::Usage,
                "a map needs a file with an extension: .csv, .json, .ply or .glb");
  const std::string extension = extension_of(path);
  if (extension == "csv") return MapFormat::Csv;
  if (extension == "json") return MapFormat::Json;
  if (extension == "ply") return MapFormat::Ply;
  if (extension == "glb") return MapFormat::Glb;
  throw Error(ErrorKind::Unsupported, path + ": maps are .csv, .json, .ply or .glb files");
}

std::string map_file(const std::variant<Shape, Volume>& shape, const CurveSkeleton& skeleton,
                     MapFormat format) {
  return std::visit([&](const auto& input) { return map_file_of(input, skeleton, format); }, shape);
}

}  // namespace marrow
