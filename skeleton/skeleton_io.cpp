#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/skeleton_io.hpp>

#include <algorithm>
#include <cmath>

#include "skeleton_text_detail.hpp"

namespace marrow {

namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;

bool is_writable(const CurveSkeleton::Node& node) {
  return std::isfinite(node.position.x) && std::isfinite(node.position.y) &&
         std::isfinite(node.position.z) && std::isfinite(node.radius);
}

}  // namespace

SkeletonFormat skeleton_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "obj") return SkeletonFormat::Obj;
  if (extension == "skel") return SkeletonFormat::Skel;
  if (extension == "ply") return SkeletonFormat::Ply;
  if (extension == "json") return SkeletonFormat::Json;
  throw Error(ErrorKind::Unsupported,
              path + ": curve-skeletons are .obj, .skel, .ply or .json files; rename it");
}

std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format) {
  if (!std::all_of(skeleton.nodes.begin(), skeleton.nodes.end(), is_writable))
    throw Error(ErrorKind::Internal, "a node of the curve-skeleton is not finite");
  switch (format) {
    case SkeletonFormat::Obj:
      return skeleton_detail::format_obj(skeleton);
    case SkeletonFormat::Skel:
      return skeleton_detail::format_skel(skeleton);
    case SkeletonFormat::Ply:
      return skeleton_detail::format_ply(skeleton);
    case SkeletonFormat::Json:
      return skeleton_detail::format_json(skeleton);
  }
  throw Error(ErrorKind::Internal, "no such format of a curve-skeleton");
}

CurveSkeleton parse_skeleton(std::string_view bytes, SkeletonFormat format,
                             const std::string& name) {
  switch (format) {
    case SkeletonFormat::Obj:
      return skeleton_detail::parse_obj(bytes, name);
    case SkeletonFormat::Skel:
      return skeleton_detail::parse_skel(bytes, name);
    case SkeletonFormat::Ply:
      return skeleton_detail::parse_ply(bytes, name);
    case SkeletonFormat::Json:
      return skeleton_detail::parse_json(bytes, name);
  }
  throw Error(ErrorKind::Internal, "no such format of a curve-skeleton");
}

CurveSkeleton read_skeleton(const std::string& path) {
  const SkeletonFormat format = skeleton_format_of(path);
  return parse_skeleton(read_file(path, kMaxBytes), format, path);
}

void write_skeleton(const std::string& path, const CurveSkeleton& skeleton) {
  write_file(path, format_skeleton(skeleton, skeleton_format_of(path)));
}

}  // namespace marrow
