// Reading and writing shapes: OBJ, PLY, STL, OFF.
#pragma once

#include <marrow/shape.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace marrow {

enum class ShapeFormat { Obj, Ply, Stl, Off };

struct ReadOptions {
  std::uint64_t max_bytes = std::uint64_t{4} << 30;  ///< larger files are refused (Limit)
  std::uint64_t max_triangles = 200'000'000;         ///< more triangles are refused (Limit)
};

/// The format that the extension of `path` names. Throws Error: Unsupported.
ShapeFormat shape_format_of(const std::string& path);

/// Reads a shape; polygons, also concave ones, are cut into triangles, points that no face uses stay
/// (they never count). No other file that this one names is ever opened.
/// Throws Error: CannotRead, Malformed (names the line or byte and the mend), Unsupported, Empty (no
/// faces and no points), Limit.
Shape read_shape(const std::string& path, const ReadOptions& options = {});

/// The same from bytes in memory; `name` stands for the file in messages.
Shape parse_shape(std::string_view bytes, ShapeFormat format, const std::string& name,
                  const ReadOptions& options = {});

/// Writes `shape` whole or not at all; the extension of `path` names the format (PLY and STL binary).
/// Throws Error: Unsupported, CannotWrite.
void write_shape(const std::string& path, const Shape& shape);

/// The bytes that write_shape() writes.
std::string format_shape(const Shape& shape, ShapeFormat format);

}  // namespace marrow
