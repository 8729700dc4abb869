// XYZ, PTS, TXT, ASC and CSV: a point to a line, whatever else stands behind it.

#include <marrow/error.hpp>

#include <algorithm>
#include <optional>

#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

using text_detail::quoted;

constexpr char kBlank = ' ';

std::string_view trimmed(std::string_view text) {
  text_detail::skip_blanks(text);
  while (!text.empty() && text_detail::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// What stands between two fields of a file, by one of its lines.
char separator_of(std::string_view line) {
  for (const char c : {';', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return kBlank;
}

/// Takes the first field off a line.
std::string_view take_field(std::string_view& line, char separator) {
  if (separator == kBlank) return text_detail::take_word(line);
  const std::size_t end = std::min(line.find(separator), line.size());
  const std::string_view field = trimmed(line.substr(0, end));
  line.remove_prefix(std::min(end + 1, line.size()));
  return field;
}

bool is_number(std::string_view field, double& value) {
  return text_detail::take_number(field, value) && field.empty();
}

/// Lines of points, and before them a count or the names of the columns, where there are any.
class XyzReader {
 public:
  explicit XyzReader(const Source& source)
      : name_(source.name), lines_(text_detail::without_mark(source.bytes)), builder_(source, "") {}

  Shape read() && {
    if (next_line()) {
      separator_ = separator_of(line_);
      if (!is_heading()) read_point();
      while (next_line()) read_point();
    }
    if (count_ && *count_ != builder_.point_count())
      fail("the file ends after " + std::to_string(builder_.point_count()) + " of the " +
           std::to_string(*count_) +
           " points that it counts; it was cut short or its count is wrong");
    return std::move(builder_).finish();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, std::to_string(lines_.number()), what);
  }

  /// To the next line that is not empty; comments do not count.
  bool next_line() {
    while (text_detail::next_filled(lines_, line_)) {
      line_ = trimmed(line_);
      if (!line_.starts_with("//")) return true;
    }
    return false;
  }

  /// A count of points, or names of columns of which the first is x.
  bool is_heading() {
    std::string_view rest = line_, count = line_;
    std::string_view field = take_field(rest, separator_);
    if (field.size() > 2 && field.front() == '"' && field.back() == '"')
      field = field.substr(1, field.size() - 2);
    if (field == "x" || field == "X") return true;
    std::uint64_t points = 0;
    if (!text_detail::take_integer(count, points) || !count.empty()) return false;
    count_ = points;
    // The next line tells what stands between fields.
    const text_detail::Lines here = lines_;
    if (next_line()) separator_ = separator_of(line_);
    lines_ = here;
    return true;
  }

  void read_point() {
    if (count_ && builder_.point_count() == *count_)
      fail("the file goes on after the " + std::to_string(*count_) +
           " points that it counts; its count is too small");
    Vec3 p;
    for (double* x : {&p.x, &p.y, &p.z}) {
      const std::string_view field = take_field(line_, separator_);
      if (!is_number(field, *x))
        fail(field.empty() ? "a point has fewer than 3 numbers; write x, y and z on every line"
                           : quoted(field) +
                                 " is not a number; write x, y and z with decimal "
                                 "points, the same separator throughout");
    }
    builder_.add_point(p, lines_.number());
  }

  std::string name_;
  text_detail::Lines lines_;
  std::string_view line_;  // what is left of it
  char separator_ = kBlank;
  std::optional<std::uint64_t> count_;
  ShapeBuilder builder_;
};

}  // namespace

bool looks_like_xyz(std::string_view line) {
  const char separator = separator_of(line);
  double value = 0;
  for (int i = 0; i < 3; ++i)
    if (!is_number(take_field(line, separator), value)) return false;
  return true;
}

Shape parse_xyz(const Source& source) {
  text_detail::check_is_text(source.bytes, source.name);
  return XyzReader(source).read();
}

std::string format_xyz(const Shape& shape) {
  if (!shape.is_point_cloud())
    throw Error(ErrorKind::Unsupported, "XYZ holds points only; use OBJ, PLY, STL or OFF");
  std::string text;
  text.reserve(40 * shape.points.size());
  for (const Vec3& p : shape.points) {
    text_detail::append(text, p.x);
    text_detail::append(text += ' ', p.y);
    text_detail::append(text += ' ', p.z);
    text += '\n';
  }
  return text;
}

}  // namespace marrow::shape_detail
