// Reading and writing curve-skeletons: OBJ, SKEL, PLY, JSON.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <string>
#include <string_view>

namespace marrow {

enum class SkeletonFormat { Obj, Skel, Ply, Json };

/// The format that the extension of `path` names. Throws Error: Unsupported.
SkeletonFormat skeleton_format_of(const std::string& path);

/// The text of `skeleton`; every number in its shortest form that reads back to the same double.
/// - Obj: `v x y z radius` and `l i j` (from 1)
/// - Skel: the file of the paper's authors: id, position, radius, neighbours
/// - Ply: ascii, vertices with a radius, edges as vertex1, vertex2
/// - Json: {"format": "marrow-skeleton", "version": 1, "nodes": [[x, y, z, radius], ...],
///   "edges": [[i, j], ...]} (from 0), and counts
std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format);

/// Reads what format_skeleton() writes. `name` stands for the file in messages.
/// Throws Error: Malformed.
CurveSkeleton parse_skeleton(std::string_view bytes, SkeletonFormat format,
                             const std::string& name);

/// The same for files, whole or not at all; the extension names the format.
/// Throws Error: Unsupported, CannotRead, CannotWrite, Malformed.
CurveSkeleton read_skeleton(const std::string& path);
void write_skeleton(const std::string& path, const CurveSkeleton& skeleton);

}  // namespace marrow
