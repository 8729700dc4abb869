#include "limits.hpp"

#include <string_view>

#include "command.hpp"
#include "process.hpp"

namespace marrow {

void add_limit_options(CLI::App& verb, Limits& limits) {
  // Numbers below zero come out of the parser as very large ones.
  const auto in_range = CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62).description("");
  verb.add_option("--max-file", limits.read.max_bytes,
                  "Bytes of a file at most, also as 500K, 20M or 8G (4G by default)")
      ->transform(CLI::AsSizeValue(false).description(""))
      ->check(in_range)
      ->type_name("SIZE")
      ->group(kLimitGroup);
  verb.add_option("--max-faces", limits.read.max_triangles,
                  "Triangles of a shape at most, after its polygons have been cut")
      ->check(in_range)
      ->type_name("N")
      ->capture_default_str()
      ->group(kLimitGroup);
  verb.add_option("--timeout", limits.timeout, "Seconds at most from start to end, 0 for no limit")
      ->check(CLI::Range(0, 1'000'000'000).description(""))
      ->type_name("SECONDS")
      ->capture_default_str()
      ->group(kLimitGroup);
}

void start_clock(const Limits& limits, const std::string& file) {
  if (limits.timeout == 0) return;
  const std::string name = file == "-" ? "standard input" : file;
  end_after(limits.timeout,
            one_line("marrow: " + name + ": took longer than the limit of " +
                     std::to_string(limits.timeout) + " s; raise --timeout or simplify the file"));
}

void throw_with_option(const Error& e, const std::string& option) {
  constexpr std::string_view kWords = "raise the limit";
  std::string words = e.what();
  const std::size_t at = words.rfind(kWords);
  if (e.kind() == ErrorKind::Limit && at != std::string::npos)
    words.replace(at, kWords.size(), "raise " + option);
  throw Error(e.kind(), words);
}

}  // namespace marrow
