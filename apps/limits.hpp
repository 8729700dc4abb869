// Limits on what the program takes on.
#pragma once

#include <marrow/error.hpp>
#include <marrow/shape_io.hpp>

#include <CLI/CLI.hpp>

#include <string>

namespace marrow {

/// Where --help tells of limits.
inline constexpr const char* kLimitGroup = "Limits (exit status 7)";

struct Limits {
  ReadOptions read;
  int timeout = 3600;  ///< seconds, 0 for none
};

/// Adds --max-file, --max-faces and --timeout.
void add_limit_options(CLI::App& verb, Limits& limits);

/// Starts the clock of --timeout; `file` is what its words name, "-" for standard input.
void start_clock(const Limits& limits, const std::string& file);

/// Throws `e` again; where it says that a limit may be raised, with the name of the option.
[[noreturn]] void throw_with_option(const Error& e, const std::string& option);

}  // namespace marrow
