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
/// - Skel: the file of the paper's authors: id, position, radius, neighbours. Their own reader
///   (cinolib) drops nodes without a neighbour; ours keeps them.
/// - Ply: ascii, vertices with a radius, edges as vertex1, vertex2
/// - Json: {"format": "marrow-skeleton", "version": 1, "nodes": [[x, y, z, radius], ...],
///   "edges": [[i, j], ...]} (from 0), and counts; readers pass over keys they do not know
/// Throws Error: Internal when a node is not finite.
std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format);

/// Reads what format_skeleton() writes, and what others write of the same kind: polylines in an
/// OBJ, gaps in the ids of a SKEL, more properties in a PLY. Nodes keep their order; an edge that
/// is given twice counts once. Refused: numbers that are not finite, a radius that is missing or
/// not greater than 0, indices out of range, an edge from a node to itself, a file cut short.
/// `name` stands for the file in messages.
/// Throws Error: Malformed (names the line and the mend), Unsupported (a binary PLY, a newer JSON).
CurveSkeleton parse_skeleton(std::string_view bytes, SkeletonFormat format,
                             const std::string& name);

/// The same for files, whole or not at all; the extension names the format.
/// Throws Error: Unsupported, CannotRead, CannotWrite, Malformed, Limit (more than 1 GiB).
CurveSkeleton read_skeleton(const std::string& path);
void write_skeleton(const std::string& path, const CurveSkeleton& skeleton);

}  // namespace marrow
