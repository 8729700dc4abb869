// Reading and writing shapes: OBJ, PLY, STL, OFF, and point clouds: XYZ, PCD.
#pragma once

#include <marrow/shape.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace marrow {

enum class ShapeFormat {
  Obj,
  Ply,
  Stl,
  Off,
  Xyz,  ///< text with a point to a line: .xyz, .pts, .txt, .asc, .csv
  Pcd,  ///< of the Point Cloud Library; only read
};

struct ReadOptions {
  std::uint64_t max_bytes = std::uint64_t{4} << 30;  ///< larger files are refused (Limit)
  std::uint64_t max_triangles = 200'000'000;         ///< more triangles are refused (Limit)
};

/// The format that the extension of `path` names. Throws Error: Unsupported.
ShapeFormat shape_format_of(const std::string& path);

/// The format that the bytes of a file are in, for files without a name. `name` stands for the file
/// in messages. Throws Error: Unsupported, Empty.
ShapeFormat guess_shape_format(std::string_view bytes, const std::string& name);

/// Reads a shape; its extension names its format, and "-", standard input, is in any of them.
/// - Polygons of any number of corners, also concave ones, are cut into triangles (cut_polygon());
///   where one crosses itself, points are added behind those of the file. Faces of one or two
///   corners cover nothing and are passed over.
/// - Points that no face uses stay (they never count). If they are not finite they become 0, as all
///   coordinates of a shape are finite. A file with points and no faces gives a shape without
///   triangles.
/// - XYZ: x, y and z, apart by blanks, commas or semicolons, and whatever else stands behind them.
///   Before the points there may be their count or a line of names that begins with x. Lines that
///   begin with # or // are comments.
/// - PCD: text and binary. A point whose coordinates are not a number stands for none.
/// - Equal vertices of an STL become one; a vertex that is named in several faces of the other
///   formats is one already.
/// - Materials, normals, colours, weights, lines and all that is not known to the format are passed
///   over. No other file that this one names is ever opened.
/// Throws Error: CannotRead, Malformed (names the line or row and the mend), Unsupported, Empty (no
/// faces and no points), Limit.
Shape read_shape(const std::string& path, const ReadOptions& options = {});

/// The same from bytes in memory; `name` stands for the file in messages.
Shape parse_shape(std::string_view bytes, ShapeFormat format, const std::string& name,
                  const ReadOptions& options = {});

/// Writes `shape` whole or not at all; the extension of `path` names the format (PLY and STL
/// binary). All but STL, which holds single precision and no points without triangles, read back to
/// the same shape. Throws Error: Unsupported (also for triangles in an XYZ, and for PCD), Limit
/// (too many points for the format), CannotWrite.
void write_shape(const std::string& path, const Shape& shape);

/// The bytes that write_shape() writes.
std::string format_shape(const Shape& shape, ShapeFormat format);

}  // namespace marrow
