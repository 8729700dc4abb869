// OBJ by tinyobjloader, which validates nothing: what it gets has been checked line by line, and
// what it gives is checked again.
//
// The checker stands between the file and tinyobjloader as a stream. It keeps the vertices to
// itself, because tinyobjloader rounds their numbers, and lets only faces through: so no line can
// make it open another file, and its float and double builds are alike to us. Its callbacks give
// faces of any number of corners, where its LoadObj() stops counting at 255.
//
// Faces of bare vertex numbers are most of all lines of most files: the checker has read them when
// it has checked them, and keeps them too.

#include <marrow/error.hpp>

#include <tiny_obj_loader.h>

#include <istream>
#include <limits>
#include <streambuf>
#include <utility>

#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

using text_detail::is_blank;
using text_detail::quoted;
using text_detail::take_number;
using text_detail::take_word;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes an integer that fits into an int off `text`: the range of tinyobjloader.
bool take_index(std::string_view& text) {
  constexpr std::size_t kSafeDigits = 9;
  std::size_t i = text.starts_with('-') ? 1 : 0;
  const std::size_t first = i;
  while (i < text.size() && is_digit(text[i])) ++i;
  if (i == first) return false;
  if (i - first > kSafeDigits) {
    int value = 0;
    if (std::from_chars(text.data(), text.data() + i, value).ec != std::errc()) return false;
  }
  text.remove_prefix(i);
  return true;
}

/// A corner is v, v/vt, v//vn or v/vt/vn. Some programs leave slashes with nothing behind them.
bool take_corner(std::string_view& text) {
  if (!take_index(text)) return false;
  for (int part = 0; part < 2 && text.starts_with('/'); ++part) {
    text.remove_prefix(1);
    const bool empty = text.empty() || text[0] == '/' || is_blank(text[0]);
    if (!empty && !take_index(text)) return false;
  }
  return text.empty() || is_blank(text[0]);
}

class ObjChecker : public std::streambuf {
 public:
  explicit ObjChecker(const Source& source)
      : name_(source.name), lines_(text_detail::without_mark(source.bytes)), builder_(source, "") {}

  /// The face of the line that has just been let through.
  void add_face(std::span<const tinyobj::index_t> corners) {
    if (corners.size() != corner_count_) misread(corners.size());
    corner_count_ = 0;
    face_.clear();
    for (const tinyobj::index_t& corner : corners) face_.push_back(resolve(corner.vertex_index));
    builder_.add_face(face_);
  }

  Shape finish() && {
    if (highest_index_ > builder_.point_count()) {
      line_number_ = highest_index_line_;
      out_of_range(static_cast<std::int64_t>(highest_index_));
    }
    if (builder_.point_count() == 0 && has_statements_)
      text_detail::fail(ErrorKind::Malformed, name_, "",
                        "has no vertices ('v x y z'); check that it is an OBJ file");
    return std::move(builder_).finish();
  }

 protected:
  /// Goes on to the next face.
  int_type underflow() override {
    if (corner_count_ != 0) misread(0);
    while (lines_.next()) {
      line_number_ = lines_.number();
      std::string_view line = lines_.line();
      text_detail::skip_blanks(line);
      if (line.empty() || line[0] == '#') continue;
      has_statements_ = true;
      if (line.size() < 2 || !is_blank(line[1])) {
        if (line == "v" || line == "f") fail(quoted(line) + " without numbers");
        continue;
      }
      if (line[0] == 'v') add_vertex(whole_statement(line));
      if (line[0] == 'f' && !add_plain_face(line)) {
        let_through(whole_statement(line));
        return traits_type::to_int_type(*gptr());
      }
    }
    return traits_type::eof();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, std::to_string(line_number_), what);
  }

  [[noreturn]] void misread(std::size_t corners) const {
    text_detail::fail(ErrorKind::Internal, name_, std::to_string(line_number_),
                      "tinyobjloader found " + std::to_string(corners) + " corners, not " +
                          std::to_string(corner_count_));
  }

  [[noreturn]] void out_of_range(std::int64_t index) const {
    const std::size_t n = builder_.point_count();
    fail("vertex index " + std::to_string(index) + " is out of range, there are " +
         std::to_string(n) + (index < 0 ? " vertices before it" : " vertices") +
         "; repair or remove the face");
  }

  /// The statement that begins with `line`, without comment, over all lines that it goes on for.
  std::string_view whole_statement(std::string_view line) {
    line = text_detail::without_comment(line);
    if (!line.ends_with('\\')) return line;
    joined_.clear();
    while (line.ends_with('\\')) {
      joined_.append(line.substr(0, line.size() - 1)) += ' ';
      if (!lines_.next()) fail("the file ends where the line should go on");
      line = text_detail::without_comment(lines_.line());
    }
    return joined_.append(line);
  }

  void add_vertex(std::string_view statement) {
    std::string_view rest = statement.substr(1);
    double value[7];
    std::size_t count = 0;
    for (text_detail::skip_blanks(rest); !rest.empty(); text_detail::skip_blanks(rest)) {
      double ignored;
      if (!take_number(rest, count < 7 ? value[count] : ignored))
        fail(quoted(take_word(rest)) + " is not a number; write numbers like -1.25e3");
      ++count;
    }
    // Behind the place: a weight, a colour, or both.
    if (count != 3 && count != 4 && count != 6 && count != 7)
      fail("a vertex has 3 numbers, or 4, 6 or 7 with weight and colour, not " +
           std::to_string(count));
    builder_.add_point({value[0], value[1], value[2]}, line_number_);
  }

  /// Adds the face if its corners are nothing but the numbers of vertices, counted from the first.
  bool add_plain_face(std::string_view line) {
    constexpr std::uint32_t kSafe = 100'000'000;  // one digit more still fits into an int
    face_.clear();
    const char* at = line.data() + 1;
    const char* const end = line.data() + line.size();
    for (;;) {
      while (at != end && is_blank(*at)) ++at;
      if (at == end) break;
      std::uint32_t number = 0;
      const char* const first = at;
      for (; at != end && is_digit(*at) && number < kSafe; ++at)
        number = 10 * number + static_cast<std::uint32_t>(*at - '0');
      if (at == first || (at != end && !is_blank(*at))) return false;
      face_.push_back(number);
    }
    if (face_.empty()) return false;
    for (std::uint32_t& corner : face_) corner = resolve(static_cast<int>(corner));
    builder_.add_face(face_);
    return true;
  }

  /// Checks the words of a face and lets tinyobjloader read it.
  void let_through(std::string_view statement) {
    std::string_view rest = statement.substr(1);
    corner_count_ = 0;
    for (text_detail::skip_blanks(rest); !rest.empty(); text_detail::skip_blanks(rest)) {
      std::string_view corner = rest;
      if (!take_corner(rest))
        fail(quoted(take_word(corner)) +
             " is not a corner; write v, v/vt, v//vn or v/vt/vn with whole numbers in range");
      ++corner_count_;
    }
    if (corner_count_ == 0) fail("a face without corners");
    const std::string_view raw = lines_.raw(), line = lines_.line();
    const bool as_it_stands =
        raw.ends_with('\n') && statement.data() == line.data() && statement.size() == line.size();
    if (!as_it_stands) passed_.assign(statement) += '\n';
    // The get area is only read from.
    char* const begin = as_it_stands ? const_cast<char*>(raw.data()) : passed_.data();
    setg(begin, begin, begin + (as_it_stands ? raw.size() : passed_.size()));
  }

  /// From 0; negative indices count back from the last vertex so far.
  std::uint32_t resolve(int index) {
    if (index == 0) fail("vertex index 0; the first vertex of an OBJ file is 1");
    const auto count = static_cast<std::int64_t>(builder_.point_count());
    if (index < 0) {
      if (count + index < 0) out_of_range(index);
      return static_cast<std::uint32_t>(count + index);
    }
    // The vertex may still come: all indices are checked at the end by the highest one.
    const auto from_one = static_cast<std::uint32_t>(index);
    if (from_one > highest_index_) {
      highest_index_ = from_one;
      highest_index_line_ = line_number_;
    }
    return from_one - 1;
  }

  std::string name_;
  text_detail::Lines lines_;
  ShapeBuilder builder_;
  std::uint64_t line_number_ = 0;  // where the last statement began
  std::string joined_, passed_;    // statements that are not as they stand in the file
  std::size_t corner_count_ = 0;   // of a face that has been let through and is not back yet
  std::vector<std::uint32_t> face_;
  std::uint32_t highest_index_ = 0;
  std::uint64_t highest_index_line_ = 0;
  bool has_statements_ = false;
};

}  // namespace

Shape parse_obj(const Source& source) {
  text_detail::check_is_text(source.bytes, source.name);
  ObjChecker checker(source);
  std::istream faces(&checker);
  faces.exceptions(std::ios::badbit);  // or the stream would swallow the errors of the checker
  tinyobj::callback_t callbacks;
  callbacks.index_cb = [](void* target, tinyobj::index_t* corners, int count) {
    static_cast<ObjChecker*>(target)->add_face({corners, static_cast<std::size_t>(count)});
  };
  tinyobj::LoadObjWithCallback(faces, callbacks, &checker);
  return std::move(checker).finish();
}

std::string format_obj(const Shape& shape) {
  std::string text;
  text.reserve(40 * shape.points.size() + 24 * shape.triangles.size());
  for (const Vec3& p : shape.points) {
    text += 'v';
    for (const double x : {p.x, p.y, p.z}) text_detail::append(text += ' ', x);
    text += '\n';
  }
  for (const Triangle& t : shape.triangles) {
    text += 'f';
    for (const std::uint32_t i : t) text_detail::append(text += ' ', std::uint64_t{i} + 1);
    text += '\n';
  }
  return text;
}

}  // namespace marrow::shape_detail
