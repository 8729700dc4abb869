// What is said about bad texts of curve-skeletons in a test.
#pragma once

#include <marrow/error.hpp>
#include <marrow/skeleton_io.hpp>

#include <string>

#include "catch.hpp"

namespace marrow::test {

/// The one line that `text` is refused with, as an error of this kind; "" where it is read.
inline std::string error_of(const std::string& text, SkeletonFormat format,
                            ErrorKind kind = ErrorKind::Malformed, double missing_radius = 0) {
  try {
    parse_skeleton(text, format, "f", missing_radius);
  } catch (const Error& e) {
    CHECK(e.kind() == kind);
    CHECK(std::string(e.what()).find('\n') == std::string::npos);
    return e.what();
  }
  return "";
}

}  // namespace marrow::test
