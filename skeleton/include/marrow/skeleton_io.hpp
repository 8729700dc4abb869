// Reading and writing curve-skeletons: docs/formats.md tells what every format carries.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace marrow {

enum class SkeletonFormat {
  Obj,
  Skel,
  Ply,
  Json,
  Cg,
  Graph,
  Swc,
  Polylines,
  Vtp,
  GraphMl,
  Csv,
  Dot,  ///< written, not read
  Glb   ///< written, not read
};

/// "obj", "skel", ...: the extensions of the formats, in the order of the enum.
std::vector<std::string> skeleton_formats();
/// The same without those that are only written.
std::vector<std::string> readable_skeleton_formats();

/// The format that the extension of `path` names. Throws Error: Unsupported.
SkeletonFormat skeleton_format_of(const std::string& path);

/// The text of `skeleton`; every number in its shortest form that reads back to the same double.
/// Section radii are written where the format can carry them and one of them is known.
/// - Obj: `v x y z radius` and `l i j` (from 1)
/// - Skel: the file of the paper's authors: id, position, radius, neighbours. Their own reader
///   (cinolib) drops nodes without a neighbour; ours keeps them.
/// - Ply: ascii, vertices with a radius, edges as vertex1, vertex2
/// - Json: {"format": "marrow-skeleton", "version": 1, "nodes": [[x, y, z, radius], ...],
///   "edges": [[i, j], ...]} (from 0), and counts; with section radii it is version 2 and they are
///   the fifth numbers; readers pass over keys they do not know
/// - Cg: `v x y z` and `e i j` (from 1), then the radii as comments
/// - Graph: of GEL, `n x y z radius` and `c i j` (from 0)
/// - Swc: a tree in depth-first order from the thickest node of every part; the edges that close
///   cycles follow as comments
/// - Polylines: of CGAL, a line for every branch and every node without an edge; no radii
/// - Vtp: ascii, a cell for every branch and every node without an edge
/// - GraphMl, Dot: nodes and edges with what they measure
/// - Csv: a row for every node with its neighbours
/// - Glb: lines in single precision
/// Throws Error: Internal when a node is not finite or its section radius is below its radius;
/// Unsupported when it is too far out for the single precision of Glb.
std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format);

/// Reads what format_skeleton() writes, and what others write of the same kind: polylines in an
/// OBJ, gaps in the ids of a SKEL, more properties in a PLY, indices from 0 in a CG. Nodes keep
/// their order, except that points of Polylines at one place are one node; an edge that is given
/// twice counts once. Nodes without a radius get `missing_radius` if it is greater than 0.
/// Refused: numbers that are not finite, a radius that is not greater than 0, a section radius that
/// is neither 0 nor at least the radius, indices out of range, an edge from a node to itself, a
/// file cut short. `name` stands for the file in messages.
/// Throws Error: Malformed (names the line and the mend), Unsupported (a binary PLY or VTP, a newer
/// JSON, a format that is only written), Limit (more than 16 GiB).
CurveSkeleton parse_skeleton(std::string_view bytes, SkeletonFormat format, const std::string& name,
                             double missing_radius = 0);

/// The same for files, whole or not at all; the extension names the format.
/// Throws Error: Unsupported, CannotRead, CannotWrite, Malformed, Limit (more than 1 GiB).
CurveSkeleton read_skeleton(const std::string& path, double missing_radius = 0);
void write_skeleton(const std::string& path, const CurveSkeleton& skeleton);

}  // namespace marrow
