#include <marrow/directions_io.hpp>
#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <cmath>

#include "text_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kMost = 1024;
constexpr std::uint64_t kMostBytes = 1 << 20;

}  // namespace

std::vector<Vec3> parse_directions(std::string_view bytes, const std::string& name) {
  text_detail::Lines lines(text_detail::without_mark(bytes));
  std::string_view line;
  std::vector<Vec3> directions;
  const auto fail = [&](ErrorKind kind, const std::string& what) {
    text_detail::fail(kind, name, std::to_string(lines.number()), what);
  };
  while (text_detail::next_filled(lines, line)) {
    if (directions.size() == kMost)
      fail(ErrorKind::Limit, "there are more than 1024 directions; leave some out");
    Vec3 d;
    for (double* c : {&d.x, &d.y, &d.z}) {
      std::string_view word = text_detail::take_word(line);
      if (!text_detail::take_number(word, *c) || !word.empty() || !std::isfinite(*c))
        fail(ErrorKind::Malformed, "a direction is three finite numbers: x y z");
    }
    if (!text_detail::take_word(line).empty())
      fail(ErrorKind::Malformed, "there is more than a direction, x y z, on the line");
    if (d == Vec3{}) fail(ErrorKind::Malformed, "0 0 0 is no direction");
    directions.push_back(d);
  }
  if (directions.empty())
    throw Error(ErrorKind::Malformed, name + ": holds no direction; give one 'x y z' a line");
  return directions;
}

std::vector<Vec3> read_directions(const std::string& path) {
  return parse_directions(read_file(path, kMostBytes), path);
}

}  // namespace marrow
