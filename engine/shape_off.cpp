// OFF, the text format of Geomview: http://www.geomview.org/docs/html/OFF.html

#include <marrow/error.hpp>

#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

using text_detail::quoted;
using text_detail::take_integer;
using text_detail::take_number;
using text_detail::take_word;

class OffReader {
 public:
  explicit OffReader(const Source& source)
      : name_(source.name), lines_(text_detail::without_mark(source.bytes)), builder_(source, "") {}

  Shape read() && {
    read_header();
    const std::uint64_t points = take_count("vertices"), faces = take_count("faces");
    check_rest(points, faces);
    builder_.reserve(points, faces);
    for (std::uint64_t i = 0; i < points; ++i) read_vertex();
    for (std::uint64_t i = 0; i < faces; ++i) read_face();
    if (next_line()) fail("the file goes on after the last face; its counts are too small");
    return std::move(builder_).finish();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, std::to_string(lines_.number()), what);
  }

  bool next_line() { return text_detail::next_filled(lines_, line_); }

  void expect_line(const char* what) {
    if (!next_line()) fail(std::string("the file ends before ") + what + "; it was cut short");
  }

  /// [ST][C][N][4][n]OFF, which may stand on the line of the counts, or be left out. The letters
  /// announce more numbers behind each vertex.
  void read_header() {
    expect_line("its header");
    std::string_view rest = line_;
    std::string_view word = take_word(rest);
    if (!word.ends_with("OFF")) {
      std::uint64_t count = 0;
      if (!take_integer(word, count))
        fail("does not begin with 'OFF'; check that it is an OFF file");
      return;
    }
    word.remove_suffix(3);
    if (word.starts_with("ST")) word.remove_prefix(2);
    if (word.starts_with('C')) word.remove_prefix(1);
    if (word.starts_with('N')) word.remove_prefix(1);
    if (!word.empty())
      text_detail::fail(ErrorKind::Unsupported, name_, std::to_string(lines_.number()),
                        quoted(line_) + " is a kind of OFF that is not read; write a plain OFF");
    text_detail::skip_blanks(rest);
    if (rest.starts_with("BINARY"))
      text_detail::fail(ErrorKind::Unsupported, name_, std::to_string(lines_.number()),
                        "binary OFF is not read; write it as text");
    line_ = rest;
    if (line_.empty()) expect_line("its counts");
  }

  std::uint64_t take_count(const char* what) {
    std::uint64_t count = 0;
    if (!take_integer(line_, count))
      fail(std::string("the count of ") + what + " is missing or is not a whole number from 0 on");
    return count;
  }

  /// A count is only believed if the rest of the file has room for it.
  void check_rest(std::uint64_t points, std::uint64_t faces) const {
    constexpr std::uint64_t kShortestVertex = 6, kShortestFace = 2;  // "0 0 0\n", "0\n"
    const std::uint64_t rest = lines_.rest().size() + 1;
    if (points > rest / kShortestVertex || faces > rest / kShortestFace)
      fail("the header counts " + std::to_string(points) + " vertices and " +
           std::to_string(faces) + " faces, but only " + std::to_string(rest - 1) +
           " bytes follow; the file was cut short or its header is wrong");
  }

  void read_vertex() {
    expect_line("its last vertex");
    Vec3 p;
    for (double* x : {&p.x, &p.y, &p.z})
      if (!take_number(line_, *x)) {
        const auto word = take_word(line_);
        fail(word.empty() ? "a vertex has fewer than 3 numbers"
                          : quoted(word) + " is not a number");
      }
    builder_.add_point(p, lines_.number());
  }

  void read_face() {
    expect_line("its last face");
    std::uint64_t count = 0;
    if (!take_integer(line_, count)) fail(quoted(take_word(line_)) + " is not a count of corners");
    if (count > line_.size())
      fail("a face of " + std::to_string(count) + " corners, but its line is shorter");
    corners_.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      std::int64_t index = 0;
      if (!take_integer(line_, index)) {
        const auto word = take_word(line_);
        fail(word.empty() ? "a face has fewer corners than its count"
                          : quoted(word) + " is not a vertex index");
      }
      const auto points = static_cast<std::int64_t>(builder_.point_count());
      if (index < 0 || index >= points)
        fail("vertex index " + std::to_string(index) + " is out of range, there are " +
             std::to_string(points) + " vertices from 0 on; repair or remove the face");
      corners_.push_back(static_cast<std::uint32_t>(index));
    }
    builder_.add_face(corners_);  // what follows on the line is a colour
  }

  std::string name_;
  text_detail::Lines lines_;
  std::string_view line_;  // what is left of it
  ShapeBuilder builder_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Shape parse_off(const Source& source) {
  // A binary OFF begins like a text: its header tells more than that it is not one.
  if (source.bytes.substr(0, 32).find("BINARY") == std::string_view::npos)
    text_detail::check_is_text(source.bytes, source.name);
  return OffReader(source).read();
}

std::string format_off(const Shape& shape) {
  std::string text = "OFF\n";
  text.reserve(40 * shape.points.size() + 26 * shape.triangles.size());
  text_detail::append(text, shape.points.size());
  text_detail::append(text += ' ', shape.triangles.size());
  text += " 0\n";
  for (const Vec3& p : shape.points) {
    text_detail::append(text, p.x);
    text_detail::append(text += ' ', p.y);
    text_detail::append(text += ' ', p.z);
    text += '\n';
  }
  for (const Triangle& t : shape.triangles) {
    text += '3';
    for (const std::uint32_t i : t) text_detail::append(text += ' ', i);
    text += '\n';
  }
  return text;
}

}  // namespace marrow::shape_detail
