#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/skeleton_io.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "skeleton_text_detail.hpp"

namespace marrow {

namespace {

namespace detail = skeleton_detail;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;
/// No format has a node in fewer than 6 bytes: so many hold no more nodes than a NodeId counts.
constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 30;

struct Entry {
  SkeletonFormat format;
  const char* extension;
  std::string (*write)(const CurveSkeleton&);
  CurveSkeleton (*read)(std::string_view, const detail::Source&);  ///< null: only written
};

constexpr std::array<Entry, 13> kFormats = {{
    {SkeletonFormat::Obj, "obj", detail::format_obj, detail::parse_obj},
    {SkeletonFormat::Skel, "skel", detail::format_skel, detail::parse_skel},
    {SkeletonFormat::Ply, "ply", detail::format_ply, detail::parse_ply},
    {SkeletonFormat::Json, "json", detail::format_json, detail::parse_json},
    {SkeletonFormat::Cg, "cg", detail::format_cg, detail::parse_cg},
    {SkeletonFormat::Graph, "graph", detail::format_graph, detail::parse_graph},
    {SkeletonFormat::Swc, "swc", detail::format_swc, detail::parse_swc},
    {SkeletonFormat::Polylines, "polylines", detail::format_polylines, detail::parse_polylines},
    {SkeletonFormat::Vtp, "vtp", detail::format_vtp, detail::parse_vtp},
    {SkeletonFormat::GraphMl, "graphml", detail::format_graphml, detail::parse_graphml},
    {SkeletonFormat::Csv, "csv", detail::format_csv, detail::parse_csv},
    {SkeletonFormat::Dot, "dot", detail::format_dot, nullptr},
    {SkeletonFormat::Glb, "glb", detail::format_glb, nullptr},
}};

const Entry& entry_of(SkeletonFormat format) {
  for (const Entry& entry : kFormats)
    if (entry.format == format) return entry;
  throw Error(ErrorKind::Internal, "no such format of a curve-skeleton");
}

/// "a, b, c or d".
std::string choice_of(const std::vector<std::string>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i)
    words += (i == 0 ? "." : i + 1 < names.size() ? ", ." : " or .") + names[i];
  return words;
}

bool is_writable(const CurveSkeleton::Node& node) {
  return std::isfinite(node.position.x) && std::isfinite(node.position.y) &&
         std::isfinite(node.position.z) && std::isfinite(node.radius) &&
         std::isfinite(node.section_radius) &&
         (node.section_radius == 0 || node.section_radius >= node.radius);
}

bool is_polylines(const std::string& path) {
  constexpr std::size_t kTail = sizeof ".txt" - 1;
  return extension_of(path) == "txt" &&
         extension_of(path.substr(0, path.size() - kTail)) == "polylines";
}

}  // namespace

std::vector<std::string> skeleton_formats() {
  std::vector<std::string> names;
  for (const Entry& entry : kFormats) names.emplace_back(entry.extension);
  return names;
}

std::vector<std::string> readable_skeleton_formats() {
  std::vector<std::string> names;
  for (const Entry& entry : kFormats)
    if (entry.read != nullptr) names.emplace_back(entry.extension);
  return names;
}

SkeletonFormat skeleton_format_of(const std::string& path) {
  if (is_polylines(path)) return SkeletonFormat::Polylines;
  const std::string extension = extension_of(path);
  if (extension == "gv") return SkeletonFormat::Dot;
  for (const Entry& entry : kFormats)
    if (extension == entry.extension) return entry.format;
  throw Error(ErrorKind::Unsupported, path + ": curve-skeletons are " +
                                          choice_of(skeleton_formats()) + " files; rename it");
}

std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format) {
  if (!std::all_of(skeleton.nodes.begin(), skeleton.nodes.end(), is_writable))
    throw Error(ErrorKind::Internal,
                "a node of the curve-skeleton is not finite, or its section is below its radius");
  return entry_of(format).write(skeleton);
}

CurveSkeleton parse_skeleton(std::string_view bytes, SkeletonFormat format, const std::string& name,
                             double missing_radius) {
  const Entry& entry = entry_of(format);
  if (entry.read == nullptr)
    throw Error(ErrorKind::Unsupported, name + ": ." + entry.extension +
                                            " files of curve-skeletons are only written; use " +
                                            choice_of(readable_skeleton_formats()));
  if (bytes.size() > kMostBytes)
    throw Error(ErrorKind::Limit, name + ": a curve-skeleton of more than 16 GiB; simplify it");
  return entry.read(bytes, {name, missing_radius});
}

CurveSkeleton read_skeleton(const std::string& path, double missing_radius) {
  const SkeletonFormat format = skeleton_format_of(path);
  return parse_skeleton(read_file(path, kMaxBytes), format, path, missing_radius);
}

void write_skeleton(const std::string& path, const CurveSkeleton& skeleton) {
  write_file(path, format_skeleton(skeleton, skeleton_format_of(path)));
}

}  // namespace marrow
