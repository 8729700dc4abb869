#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/shape_io.hpp>

#include <new>
#include <stdexcept>

#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow {

namespace {

using shape_detail::Source;

constexpr const char* kFormats = "OBJ, PLY, STL, OFF, XYZ or PCD";

struct Signature {
  std::string_view bytes;
  const char* what;
};

/// Other kinds of files whose first bytes are known, for a word that helps.
constexpr Signature kForeign[] = {{"\x1f\x8b", "compressed by gzip; unpack it first"},
                                  {"BZh", "compressed by bzip2; unpack it first"},
                                  {"\xfd"
                                   "7zXZ",
                                   "compressed by xz; unpack it first"},
                                  {"\x28\xb5\x2f\xfd", "compressed by zstd; unpack it first"},
                                  {"PK\x03\x04", "a ZIP archive; unpack it first"},
                                  {"\xff\xfe", "text in UTF-16; save it as UTF-8"},
                                  {"\xfe\xff", "text in UTF-16; save it as UTF-8"},
                                  {"glTF", "a GLB file; export it as OBJ, PLY, STL or OFF"}};

void refuse_foreign(const Source& source) {
  for (const Signature& s : kForeign)
    if (source.bytes.starts_with(s.bytes))
      text_detail::fail(ErrorKind::Unsupported, source.name, "", std::string("is ") + s.what);
}

Shape parse(const Source& source, ShapeFormat format) {
  switch (format) {
    case ShapeFormat::Obj:
      return shape_detail::parse_obj(source);
    case ShapeFormat::Ply:
      return shape_detail::parse_ply(source);
    case ShapeFormat::Stl:
      return shape_detail::parse_stl(source);
    case ShapeFormat::Off:
      return shape_detail::parse_off(source);
    case ShapeFormat::Xyz:
      return shape_detail::parse_xyz(source);
    case ShapeFormat::Pcd:
      return shape_detail::parse_pcd(source);
  }
  throw Error(ErrorKind::Internal, "no such format of shapes");
}

/// True if one of the first lines begins with a vertex or a face.
bool looks_like_obj(std::string_view bytes) {
  constexpr std::uint64_t kLines = 1000;
  text_detail::Lines lines(text_detail::without_mark(bytes));
  while (lines.next() && lines.number() <= kLines) {
    std::string_view line = lines.line();
    const std::string_view word = text_detail::take_word(line);
    if (word == "v" || word == "f") return true;
  }
  return false;
}

}  // namespace

ShapeFormat shape_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "obj") return ShapeFormat::Obj;
  if (extension == "ply") return ShapeFormat::Ply;
  if (extension == "stl") return ShapeFormat::Stl;
  if (extension == "off") return ShapeFormat::Off;
  if (extension == "pcd") return ShapeFormat::Pcd;
  for (const char* const text : {"xyz", "pts", "txt", "asc", "csv"})
    if (extension == text) return ShapeFormat::Xyz;
  throw Error(ErrorKind::Unsupported,
              path + ": " +
                  (extension.empty() ? std::string("no extension names its format")
                                     : "shapes are not read from or written to ." + extension) +
                  "; use " + kFormats);
}

ShapeFormat guess_shape_format(std::string_view bytes, const std::string& name) {
  if (shape_detail::is_binary_stl(bytes)) return ShapeFormat::Stl;
  text_detail::Lines lines(text_detail::without_mark(bytes));
  while (lines.next()) {
    std::string_view line = lines.line();
    const std::string_view word = text_detail::take_word(line);
    if (word.empty() || word.starts_with('#') || word.starts_with("//")) continue;
    if (word == "ply") return ShapeFormat::Ply;
    if (word == "solid") return ShapeFormat::Stl;
    if (word.ends_with("OFF")) return ShapeFormat::Off;
    if (word == "VERSION" || word == "FIELDS") return ShapeFormat::Pcd;
    if (shape_detail::looks_like_xyz(lines.line())) return ShapeFormat::Xyz;
    break;
  }
  if (looks_like_obj(bytes)) return ShapeFormat::Obj;
  throw Error(bytes.empty() ? ErrorKind::Empty : ErrorKind::Unsupported,
              name + ": " +
                  (bytes.empty() ? "is empty" : "is in none of the formats that are read") +
                  "; use " + kFormats);
}

Shape parse_shape(std::string_view bytes, ShapeFormat format, const std::string& name,
                  const ReadOptions& options) {
  const Source source{bytes, name, options};
  if (bytes.size() > options.max_bytes)
    text_detail::fail(ErrorKind::Limit, name, "",
                      "is larger than the limit of " + std::to_string(options.max_bytes) +
                          " bytes; raise the limit or simplify the shape");
  if (bytes.empty()) text_detail::fail(ErrorKind::Empty, name, "", "is empty (0 bytes)");
  if (!shape_detail::is_binary_stl(bytes)) refuse_foreign(source);
  try {
    return parse(source, format);
  } catch (const std::bad_alloc&) {
    text_detail::fail(ErrorKind::Limit, name, "", "needs more memory than there is; simplify it");
  } catch (const std::length_error&) {
    text_detail::fail(ErrorKind::Limit, name, "", "needs more memory than there is; simplify it");
  }
}

Shape read_shape(const std::string& path, const ReadOptions& options) {
  if (path == "-") {
    const std::string bytes = read_file(path, options.max_bytes), name = "standard input";
    return parse_shape(bytes, guess_shape_format(bytes, name), name, options);
  }
  const ShapeFormat format = shape_format_of(path);
  return parse_shape(read_file(path, options.max_bytes), format, path, options);
}

void write_shape(const std::string& path, const Shape& shape) {
  const ShapeFormat format = shape_format_of(path);
  std::string bytes;
  try {
    bytes = format_shape(shape, format);
  } catch (const Error& e) {
    throw Error(e.kind(), path + ": " + e.what());
  }
  write_file(path, bytes);
}

std::string format_shape(const Shape& shape, ShapeFormat format) {
  switch (format) {
    case ShapeFormat::Obj:
      return shape_detail::format_obj(shape);
    case ShapeFormat::Ply:
      return shape_detail::format_ply(shape);
    case ShapeFormat::Stl:
      return shape_detail::format_stl(shape);
    case ShapeFormat::Off:
      return shape_detail::format_off(shape);
    case ShapeFormat::Xyz:
      return shape_detail::format_xyz(shape);
    case ShapeFormat::Pcd:
      throw Error(ErrorKind::Unsupported, "PCD is only read; use PLY or XYZ");
  }
  throw Error(ErrorKind::Internal, "no such format of shapes");
}

}  // namespace marrow
