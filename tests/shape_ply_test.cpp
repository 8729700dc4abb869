#include <marrow/shape_io.hpp>

#include <algorithm>
#include <bit>
#include <cstring>

#include "shape_text.hpp"

using namespace marrow;

namespace {

Shape ply(std::string_view bytes) { return parse_shape(bytes, ShapeFormat::Ply, "file"); }

void check_malformed(std::string_view bytes, const std::string& place, std::string_view part) {
  marrow::check_malformed(bytes, ShapeFormat::Ply, place, part);
}

/// Bytes of numbers, lowest or highest first.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}

  template <class Number>
  Bytes& add(std::initializer_list<Number> values) {
    for (const Number v : values) {
      std::string bytes(sizeof v, '\0');
      std::memcpy(bytes.data(), &v, sizeof v);
      if (big_ == (std::endian::native == std::endian::little))
        std::reverse(bytes.begin(), bytes.end());
      text_ += bytes;
    }
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_;
  std::string text_;
};

std::string format_line(bool big) {
  return std::string("format binary_") + (big ? "big" : "little") + "_endian 1.0\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kText = "ply\nformat ascii 1.0\nelement vertex 4\n" + kXyz +
                          "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const Shape kTwoTriangles{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("PLY: text", "[shape_io][ply]") {
  CHECK(ply(kText) == kTwoTriangles);
  CHECK(ply(kText.substr(0, kText.size() - 1)) == kTwoTriangles);
  CHECK(ply(replaced(kText, "indices", "index")) == kTwoTriangles);
  CHECK(ply(replaced(replaced(kText, "face 2", "face 1"), "3 0 1 2\n3 0 2 3", "4 0 1 2 3")) ==
        kTwoTriangles);
  std::string crlf;
  for (const char c : kText) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(ply(crlf) == kTwoTriangles);
  std::string cr = kText;
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  CHECK(ply(cr) == kTwoTriangles);
}

TEST_CASE("PLY: what is not known is skipped", "[shape_io][ply]") {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement camera 1\nproperty float f\n"
      "property list uchar float k\nelement vertex 4\nproperty uchar red\nproperty double z\n"
      "property list int float w\nproperty double x\nproperty short y\nelement empty 99\n"
      "element face 2\nproperty float q\nproperty list uchar uint vertex_index\n"
      "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\n"
      "property int vertex2\nend_header\n"
      "1.5 2 3 4\n"
      "255 0 0 0 0\n\n9 0 2 7 7 1 0\n9 0 0 1 1\n9 0 1 5 0 1\n"
      ".5 3 0 1 2 0\n.5 3 0 2 3 2 1 1\n0 1\n";
  CHECK(ply(text) == kTwoTriangles);
}

TEST_CASE("PLY: binary of both byte orders", "[shape_io][ply]") {
  for (const bool big : {false, true}) {
    const std::string header = "ply\n" + format_line(big) + "element vertex 4\n" + kXyz +
                               "element face 2\nproperty list uchar int vertex_indices\n";
    Bytes body(big);
    body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    Bytes quad = body;
    body.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2});
    body.add<std::uint8_t>({3}).add<std::int32_t>({0, 2, 3});
    CHECK(ply(header + "end_header\n" + body.text()) == kTwoTriangles);
    CHECK(ply(header + "end_header\r\n" + body.text()).points.size() == 4);
    CHECK(ply(header + "end_header\n" + body.text() + "\n") == kTwoTriangles);
    quad.add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
    CHECK(ply(replaced(header, "face 2", "face 1") + "end_header\n" + quad.text()) ==
          kTwoTriangles);
  }
}

TEST_CASE("PLY: binary with all types and more than is known", "[shape_io][ply]") {
  for (const bool big : {false, true}) {
    const std::string header =
        "ply\n" + format_line(big) +
        "element camera 2\nproperty ushort a\nproperty list uint short b\n"
        "element plain 3\nproperty double a\n"
        "element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\n"
        "property char z\nproperty list uchar int w\n"
        "element face 4\nproperty int8 flag\nproperty list int ushort vertex_indices\n"
        "property list uint8 float32 texcoord\n"
        "element tail 1\nproperty int a\nend_header\n";
    Bytes b(big);
    for (int i = 0; i < 2; ++i)
      b.add<std::uint16_t>({7}).add<std::uint32_t>({2}).add<std::int16_t>({1, 2});
    b.add<double>({1, 2, 3});
    const auto vertex = [&](double x, float y) {
      b.add<std::uint8_t>({9}).add<double>({x}).add<float>({y}).add<std::int8_t>({0});
      b.add<std::uint8_t>({1}).add<std::int32_t>({5});
    };
    vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1);
    const auto face = [&](std::initializer_list<std::uint16_t> corners) {
      b.add<std::int8_t>({-1}).add<std::int32_t>({static_cast<std::int32_t>(corners.size())});
      b.add(corners).add<std::uint8_t>({2}).add<float>({.5f, .5f});
    };
    face({0, 1, 2}), face({}), face({0, 1}), face({0, 2, 3});
    b.add<std::int32_t>({3});
    CHECK(ply(header + b.text()) == kTwoTriangles);
    for (std::size_t size = 0; size < b.text().size(); ++size) {
      const Refusal refusal = refusal_of(header + b.text().substr(0, size), ShapeFormat::Ply);
      INFO(size << " " << refusal.words);
      CHECK(refusal.kind == ErrorKind::Malformed);
      CHECK_FALSE(refusal.says("goes on"));
    }
  }
}

TEST_CASE("PLY: triangles, polygons and triangles again keep their order", "[shape_io][ply]") {
  Bytes b(false);
  b.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  b.add<std::uint8_t>({3}).add<std::uint32_t>({1, 2, 3}).add<std::uint8_t>({77});
  b.add<std::uint8_t>({4}).add<std::uint32_t>({0, 1, 2, 3}).add<std::uint8_t>({77});
  b.add<std::uint8_t>({3}).add<std::uint32_t>({3, 2, 1}).add<std::uint8_t>({77});
  const Shape shape =
      ply("ply\n" + format_line(false) + "element vertex 4\n" + kXyz +
          "element face 3\nproperty list uchar uint vertex_indices\nproperty uchar red\n"
          "end_header\n" +
          b.text());
  CHECK(shape.triangles == std::vector<Triangle>{{1, 2, 3}, {0, 1, 2}, {0, 2, 3}, {3, 2, 1}});
}

TEST_CASE("PLY: strips of triangles", "[shape_io][ply]") {
  const std::string text = "ply\nformat ascii 1.0\nelement vertex 5\n" + kXyz +
                           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n8 0 1 2 3 -1 2 3 4\n";
  CHECK(ply(text).triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}});
  check_malformed(replaced(text, "3 4\n", "3 5\n"), "15", "5 is out of range");
}

TEST_CASE("PLY: points without faces are a shape of points", "[shape_io][ply]") {
  const Shape shape =
      ply("ply\nformat ascii 1.0\nelement vertex 2\n" + kXyz + "end_header\n1 2 3\n4 5 6\n");
  CHECK(shape == Shape{{{1, 2, 3}, {4, 5, 6}}, {}});
}

TEST_CASE("PLY: counts are believed only if there is room", "[shape_io][ply]") {
  check_malformed(replaced(kText, "vertex 4", "vertex 4000000000"), "header", "4000000000 rows");
  check_malformed(replaced(kText, "vertex 4", "vertex 18446744073709551615"), "header", "rows");
  check_malformed(replaced(kText, "vertex 4", "vertex 18446744073709551616"), "3", "whole number");
  check_malformed(replaced(kText, "vertex 4", "vertex -4"), "3", "whole number");
  check_malformed(replaced(kText, "face 2", "face 4294967296"), "header", "4294967296 rows");
  check_malformed(replaced(kText, "face 2", "face 3"), "15", "cut short");
  check_malformed(replaced(kText, "face 2", "face 1"), "15", "goes on");
  check_malformed(replaced(kText, "3 0 1 2", "-3 0 1 2"), "14", "a list of -3");
  check_malformed(replaced(kText, "3 0 1 2", "4000000000 0 1 2"), "14", "a list of 4000000000");
  check_malformed(replaced(kText, "3 0 1 2", "4 0 1 2"), "14", "line ends");
  check_malformed(replaced(kText, "3 0 1 2", "2 0 1 2"), "14", "goes on with '2'");
}

TEST_CASE("PLY: a binary file that is cut anywhere is refused", "[shape_io][ply]") {
  const std::string whole = format_shape(kTwoTriangles, ShapeFormat::Ply);
  CHECK(ply(whole) == kTwoTriangles);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Refusal refusal = refusal_of(whole.substr(0, size), ShapeFormat::Ply);
    INFO(size << " " << refusal.words);
    CHECK(refusal.kind.has_value());
    CHECK(refusal.kind != ErrorKind::Internal);
  }
  check_malformed(whole.substr(0, whole.size() - 1), "face 1", "no room");
  check_malformed(whole + std::string(20, 'x'), "", "goes on for 20 bytes");
  const std::string header = whole.substr(0, whole.size() - 4 * 24 - 2 * 13);
  check_malformed(header + std::string(4 * 24, '\0') +
                      std::string("\3\0\0\0\0\4\0\0\0\0\0\0\0", 13) + std::string(13, '\0'),
                  "face 0", "4 is out of range");
  check_malformed(header + std::string(4 * 24, '\0') + "\xff" + std::string(25, '\0'), "face 0",
                  "a list of 255");
}

TEST_CASE("PLY: indices are checked", "[shape_io][ply]") {
  check_malformed(replaced(kText, "3 0 1 2", "3 0 1 4"), "14", "4 is out of range");
  check_malformed(replaced(kText, "3 0 1 2", "3 0 1 -1"), "14", "-1 is out of range");
  check_malformed(replaced(kText, "3 0 1 2", "3 0 1 2.5"), "14", "'2.5'");
  check_malformed(replaced(kText, "3 0 1 2", "3 0 1 99999999999999999999"), "14", "whole number");
  check_malformed(replaced(kText, "uchar int", "uchar float"), "header", "integer type");
  check_malformed(replaced(kText, "uchar int", "float int"), "8", "not an integer type");
}

TEST_CASE("PLY: headers that are wrong", "[shape_io][ply]") {
  check_malformed("\x89PNG\r\n\x1a\n", "1", "'ply'");
  check_malformed("plywood\n", "1", "'ply'");
  check_malformed("ply\n", "1", "end_header");
  check_malformed("ply\nend_header\n", "2", "'format'");
  check_malformed("ply\nformat ascii 1.0\nhello\n", "3", "'hello'");
  check_malformed("ply\nformat ascii 1.0\nproperty float x\n", "3", "before the first element");
  check_malformed(replaced(kText, "float y", "floof y"), "5", "'floof'");
  check_malformed(replaced(kText, "float y", "float"), "5", "without a name");
  check_malformed(replaced(kText, "float y", "float v"), "header", "without x, y and z");
  check_malformed(replaced(kText, "vertex_indices", "corners"), "header", "vertex_indices");
  check_malformed("ply\nformat ascii 1.0\nelement vertex 3\nend_header\n", "header", "x, y and z");
  check_malformed(
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nelement face 1\n"
      "property list uchar uchar vertex_index\nend_header\n\3" +
          std::string("\0\1\2", 3),
      "header", "x, y and z");
  check_malformed(replaced(kText, "element face", "element vertex"), "7", "twice");
  CHECK(refusal_of(replaced(kText, "ascii", "utf8"), ShapeFormat::Ply).kind ==
        ErrorKind::Unsupported);
  CHECK(refusal_of("ply\nformat ascii 1.0\nend_header\n", ShapeFormat::Ply).kind ==
        ErrorKind::Empty);
  CHECK(refusal_of("ply\nformat ascii 1.0\nelement vertex 0\n" + kXyz + "end_header\n",
                   ShapeFormat::Ply)
            .kind == ErrorKind::Empty);
}

TEST_CASE("PLY: points that are not finite", "[shape_io][ply]") {
  check_malformed(replaced(kText, "1 1 0\n", "1 nan 0\n"), "12", "not finite");
  const std::string nan = replaced(format_shape(kTwoTriangles, ShapeFormat::Ply), "\xf0\x3f",
                                   "\xf0\x7f");  // 1 becomes infinite
  check_malformed(nan, "vertex 1", "inf");
  CHECK(ply(replaced(replaced(kText, "0 1 0\n", "0 1 inf\n"), "3 0 2 3", "3 0 1 2")).points[3] ==
        Vec3{});
}
