// Shapes from text in a test, and what is said about bad ones.
#pragma once

#include <marrow/error.hpp>
#include <marrow/shape_io.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "catch.hpp"

namespace marrow {

/// What a reader says about bytes: nothing if they are a shape.
struct Refusal {
  std::optional<ErrorKind> kind;
  std::string words;

  bool says(std::string_view part) const { return words.find(part) != std::string::npos; }
};

inline Refusal refusal_of(std::string_view bytes, ShapeFormat format,
                          const ReadOptions& options = {}) {
  try {
    parse_shape(bytes, format, "file", options);
    return {};
  } catch (const Error& e) {
    return {e.kind(), e.what()};
  }
}

/// Refused as malformed, in one line that begins with the name, then the place, and says `part`.
inline void check_malformed(std::string_view bytes, ShapeFormat format, const std::string& place,
                            std::string_view part) {
  const Refusal refusal = refusal_of(bytes, format);
  INFO(refusal.words);
  CHECK(refusal.kind == ErrorKind::Malformed);
  CHECK(refusal.words.starts_with("file:" + (place.empty() ? " " : place + ": ")));
  CHECK(refusal.says(part));
  CHECK_FALSE(refusal.says("\n"));
}

/// What is true of every shape that comes out of a reader.
inline bool is_sound(const Shape& shape) {
  for (const Vec3& p : shape.points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  for (const Triangle& t : shape.triangles)
    for (const auto i : t)
      if (i >= shape.points.size()) return false;
  return !shape.points.empty();
}

}  // namespace marrow
