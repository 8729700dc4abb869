// STL, text and binary. The format repeats every vertex in each of its triangles; vertices of equal
// coordinates become one here, so that a shape gives the same result from an STL as from other
// files, and takes as little memory.

#include <marrow/error.hpp>

#include <cmath>
#include <limits>

#include "bytes_detail.hpp"
#include "place_table_detail.hpp"
#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

using text_detail::quoted;
using text_detail::take_number;
using text_detail::take_word;

constexpr std::size_t kHeaderBytes = 80, kFirstTriangle = 84, kTriangleBytes = 50;

std::uint32_t binary_count(std::string_view bytes) {
  return bytes_detail::load<std::uint32_t, std::endian::little>(bytes.data() + kHeaderBytes);
}

/// Gives every place in space one point of the builder.
class Welder {
 public:
  Welder(ShapeBuilder& builder, std::size_t expected) : builder_(builder), places_(expected) {}

  std::uint32_t point_at(Vec3 p, std::uint64_t number) {
    p = p + Vec3{0, 0, 0};  // minus zero is the same place as zero
    const auto next = static_cast<std::uint32_t>(builder_.point_count());
    const std::uint32_t point =
        places_.number_at(p, next, [&](std::uint32_t i) { return builder_.points()[i]; });
    if (point == next) builder_.add_point(p, number);
    return point;
  }

 private:
  ShapeBuilder& builder_;
  PlaceTable places_;
};

Shape parse_binary(const Source& source) {
  using bytes_detail::load;
  const std::uint32_t count = binary_count(source.bytes);
  ShapeBuilder builder(source, "triangle ");
  builder.reserve(count / 2 + 3, count);
  Welder welder(builder, count / 2);
  const char* at = source.bytes.data() + kFirstTriangle;
  constexpr std::size_t kNormalBytes = 12, kFloatBytes = 4;
  for (std::uint32_t i = 0; i < count; ++i, at += kTriangleBytes) {
    Triangle triangle;
    const char* x = at + kNormalBytes;
    for (std::uint32_t& corner : triangle) {
      const auto next = [&] {
        const float value = load<float, std::endian::little>(x);
        x += kFloatBytes;
        return static_cast<double>(value);
      };
      const double px = next(), py = next(), pz = next();
      corner = welder.point_at({px, py, pz}, i);
    }
    builder.add_triangle(triangle);
  }
  if (count == 0) text_detail::fail(ErrorKind::Empty, source.name, "", "holds no triangles");
  return std::move(builder).finish();
}

bool equal_ignoring_case(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] + 32) : word[i];
    if (c != lower_case[i]) return false;
  }
  return true;
}

/// One word after the other: line ends are blanks to text STL but for the name behind "solid".
class TextReader {
 public:
  explicit TextReader(const Source& source)
      : name_(source.name),
        lines_(text_detail::without_mark(source.bytes)),
        builder_(source, ""),
        welder_(builder_, 0) {}

  Shape read() && {
    while (next_line()) {
      expect("solid");
      line_ = {};
      for (;;) {
        const std::string_view word = next_word("endsolid");
        if (equal_ignoring_case(word, "endsolid")) break;
        if (!equal_ignoring_case(word, "facet")) unexpected(word, "facet' or 'endsolid");
        read_facet();
      }
      line_ = {};
    }
    if (builder_.point_count() == 0)
      text_detail::fail(ErrorKind::Empty, name_, "", "holds no triangles");
    return std::move(builder_).finish();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    text_detail::fail(ErrorKind::Malformed, name_, std::to_string(lines_.number()), what);
  }
  [[noreturn]] void unexpected(std::string_view word, const std::string& wanted) const {
    fail(quoted(word) + " where '" + wanted + "' should stand");
  }

  /// To the next word, over the ends of lines.
  bool next_line() {
    for (text_detail::skip_blanks(line_); line_.empty(); text_detail::skip_blanks(line_)) {
      if (!lines_.next()) return false;
      line_ = lines_.line();
    }
    return true;
  }
  std::string_view next_word(const char* wanted) {
    if (!next_line())
      fail(std::string("the file ends where '") + wanted + "' should stand; it was cut short");
    return take_word(line_);
  }
  void expect(const char* wanted) {
    const std::string_view word = next_word(wanted);
    if (!equal_ignoring_case(word, wanted)) unexpected(word, wanted);
  }

  void read_facet() {
    expect("normal");
    // Normals do not count, and are often not even numbers.
    for (int i = 0; i < 3; ++i) next_word("the normal");
    expect("outer");
    expect("loop");
    loop_.clear();
    for (;;) {
      const std::string_view word = next_word("endloop");
      if (equal_ignoring_case(word, "endloop")) break;
      if (!equal_ignoring_case(word, "vertex")) unexpected(word, "vertex' or 'endloop");
      loop_.push_back(read_vertex());
    }
    expect("endfacet");
    builder_.add_face(loop_);
  }

  std::uint32_t read_vertex() {
    Vec3 p;
    for (double* x : {&p.x, &p.y, &p.z}) {
      if (!next_line()) fail("the file ends inside of a vertex; it was cut short");
      if (!take_number(line_, *x)) fail(quoted(take_word(line_)) + " is not a number");
    }
    return welder_.point_at(p, lines_.number());
  }

  std::string name_;
  text_detail::Lines lines_;
  std::string_view line_;  // what is left of it
  ShapeBuilder builder_;
  Welder welder_;
  std::vector<std::uint32_t> loop_;
};

/// Binary files may begin with "solid" too, and lie about their size: a text goes on with "facet".
bool looks_like_text(std::string_view bytes) {
  text_detail::Lines lines(text_detail::without_mark(bytes));
  bool seen_solid = false;
  while (lines.next()) {
    std::string_view line = lines.line();
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    if (seen_solid)
      return equal_ignoring_case(word, "facet") || equal_ignoring_case(word, "endsolid");
    if (!equal_ignoring_case(word, "solid")) return false;
    seen_solid = true;
  }
  return seen_solid && !text_detail::has_control_characters(bytes);
}

void append_vector(std::string& bytes, const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) {
    if (std::abs(x) > static_cast<double>(std::numeric_limits<float>::max()))
      throw Error(
          ErrorKind::Unsupported,
          "an STL's single precision cannot hold a coordinate of this shape; write PLY or OBJ");
    bytes_detail::append_little(bytes, static_cast<float>(x));
  }
}

Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double size = length(n);
  return size > 0 && std::isfinite(size) ? n / size : Vec3{};
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kFirstTriangle &&
         bytes.size() == kFirstTriangle + std::uint64_t{binary_count(bytes)} * kTriangleBytes;
}

Shape parse_stl(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (is_binary_stl(bytes)) return parse_binary(source);
  if (looks_like_text(bytes)) {
    text_detail::check_is_text(bytes, source.name);
    return TextReader(source).read();
  }
  if (bytes.size() < kFirstTriangle)
    text_detail::fail(ErrorKind::Malformed, source.name, "",
                      "is neither a text STL ('solid ...') nor long enough for a binary one");
  // Some programs append a few bytes; whole triangles that are not counted would be lost.
  const std::uint64_t counted = binary_count(bytes), rest = bytes.size() - kFirstTriangle;
  if (rest < counted * kTriangleBytes || rest - counted * kTriangleBytes >= kTriangleBytes)
    text_detail::fail(
        ErrorKind::Malformed, source.name, "header",
        "counts " + std::to_string(counted) + " triangles, but the file has room for " +
            std::to_string(rest / kTriangleBytes) + "; it was cut short or is not an STL");
  return parse_binary(source);
}

std::string format_stl(const Shape& shape) {
  if (shape.triangles.empty())
    throw Error(ErrorKind::Unsupported,
                "an STL holds triangles only, and the shape has none; write PLY");
  if (shape.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::Limit, "an STL holds at most 4294967295 triangles; write PLY");
  std::string bytes = "binary STL by marrow";
  bytes.reserve(kFirstTriangle + kTriangleBytes * shape.triangles.size());
  bytes.resize(kHeaderBytes, ' ');
  bytes_detail::append_little(bytes, static_cast<std::uint32_t>(shape.triangles.size()));
  for (const Triangle& t : shape.triangles) {
    const Vec3 &a = shape.points[t[0]], &b = shape.points[t[1]], &c = shape.points[t[2]];
    append_vector(bytes, unit_normal(a, b, c));
    for (const Vec3& p : {a, b, c}) append_vector(bytes, p);
    bytes_detail::append_little(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace marrow::shape_detail
