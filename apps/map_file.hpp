// Surface maps as files.
#pragma once

#include <marrow/surface_map.hpp>

#include <string>
#include <variant>

namespace marrow {

enum class MapFormat { Csv, Json, Ply, Glb };

/// Of the extension of `path`. Throws Error: Unsupported; Usage for "-", which has none.
MapFormat map_format_of(const std::string& path);

/// The map of `shape` onto `skeleton`, as a file:
/// - Csv: `point,node,branch,part`, or `x,y,z,node,branch,part` for the voxels of a volume; all are
///   counted from 0
/// - Json: {"format": "marrow-map", "version": 1, "of": "points" or "voxels", "parts", "branches":
///   the nodes along each, "node", "branch" and "part": a number for every point}; of a volume also
///   "voxels": its sides, and "index": x + nx (y + ny z)
/// - Ply: binary, the shape itself with red, green and blue by branch, and node, branch and part; a
///   volume as the middles of its voxels
/// - Glb: a mesh with joints and skin weights, see format_rig_glb()
/// Throws Error: Empty (the skeleton has no nodes), Unsupported (a rig of a volume).
std::string map_file(const std::variant<Shape, Volume>& shape, const CurveSkeleton& skeleton,
                     MapFormat format);

}  // namespace marrow
