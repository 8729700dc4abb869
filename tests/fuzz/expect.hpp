// What a fuzz target is sure of: where it is wrong, the program ends as a crash does.
#pragma once

#include <marrow/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace marrow::fuzz {

inline void expect(bool ok, const std::string& words) {
  if (ok) return;
  std::fprintf(stderr, "not as promised: %s\n", words.c_str());
  std::abort();
}

/// The error of a reader is one line that begins with the name of the file, "file".
inline void expect_clean(const Error& e) {
  const std::string words = e.what();
  const bool is_of_file = e.kind() == ErrorKind::Malformed || e.kind() == ErrorKind::Unsupported ||
                          e.kind() == ErrorKind::Empty || e.kind() == ErrorKind::Limit;
  expect(is_of_file, "the kind of error " + std::to_string(static_cast<int>(e.kind())));
  expect(words.starts_with("file:"), "no name in '" + words + "'");
  expect(words.find('\n') == std::string::npos, "two lines: '" + words + "'");
}

}  // namespace marrow::fuzz
