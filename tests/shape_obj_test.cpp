#include <marrow/shape_io.hpp>

#include <bit>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "sample_shapes.hpp"
#include "shape_text.hpp"

using namespace marrow;

namespace {

Shape obj(std::string_view text) { return parse_shape(text, ShapeFormat::Obj, "file"); }

void check_malformed(std::string_view text, const std::string& place, std::string_view part) {
  marrow::check_malformed(text, ShapeFormat::Obj, place, part);
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const Shape kTwoTriangles{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

}  // namespace

TEST_CASE("OBJ: vertices and faces in all their forms", "[shape_io][obj]") {
  CHECK(obj(kSquare + "f 1 2 3\nf 1 3 4\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f 1 2 3 4\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f 1/1 2/1 3/1 4/1\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f 1//7 2//7 3//7 4//7\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f 1/9/7 2/9/7 3/9/7 4/9/7\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f 1/ 2// 3/9/ 4\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f -4 -3 -2\nf -4/-1 -2/-1 -1/-1\n") == kTwoTriangles);
  CHECK(obj(kSquare + "f 0001 2 0000000000003\nf 1 3 4") == kTwoTriangles);
  CHECK(obj("f 1 2 3 4\n" + kSquare) == kTwoTriangles);
}

TEST_CASE("OBJ: relative indices count from where they stand", "[shape_io][obj]") {
  const Shape shape = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -2\n");
  CHECK(shape.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}});
  CHECK(obj("v 0 0 0\rv 1 0 0\rv 0 1 0\rf -3 -2 -1\rv 5 5 5\rf -4 -3 -2\r") == shape);
}

TEST_CASE("OBJ: coordinates are the nearest doubles", "[shape_io][obj]") {
  test::Random random(21);
  int different = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string number = random.below(2) == 1 ? "-" : "";
    const std::uint32_t digits = 1 + random.below(22), point = random.below(digits + 8);
    for (std::uint32_t k = 0; k < digits; ++k) {
      if (k == point) number += '.';
      number += static_cast<char>('0' + random.below(random.below(3) == 0 ? 1 : 10));
    }
    if (random.below(8) == 0)
      number.append("e").append(std::to_string(static_cast<int>(random.below(40)) - 20));
    const double x = obj("v " + number + " 0 " + number + "\n").points[0].x;
    different += std::bit_cast<std::uint64_t>(x) !=
                 std::bit_cast<std::uint64_t>(std::strtod(number.c_str(), nullptr));
  }
  CHECK(different == 0);
  CHECK(obj("v .5 5. -.5\n").points[0] == Vec3{0.5, 5, -0.5});
  for (const char* word : {".", "-", "-.", "1.2.3", "1-", "--1", "0x1", "1,5"})
    check_malformed("v 1 2 " + std::string(word) + "\n", "1", word);
}

TEST_CASE("OBJ: plain faces give what all others give", "[shape_io][obj]") {
  test::Random random(22);
  const Shape soup = test::make_soup(random, 300, 500);
  const std::string points = format_shape({soup.points, {}}, ShapeFormat::Obj);
  std::string plain = points, mixed = points;
  for (const Triangle& t : soup.triangles) {
    plain += 'f', mixed += 'f';
    for (const std::uint32_t i : t) {
      plain.append(" ").append(std::to_string(i + 1));
      mixed.append(" ").append(std::to_string(static_cast<int>(i) + 1));
      if (random.below(3) == 0) mixed.append("/1/1");
    }
    plain += random.below(2) == 1 ? " \t\n" : "\n", mixed += '\n';
  }
  CHECK(obj(plain) == soup);
  CHECK(obj(mixed) == soup);
  // A number too many digits for a plain one may still be a vertex.
  CHECK(obj(kSquare + "f 1 2 00000000003\nf 1 3 4\n") == kTwoTriangles);
}

TEST_CASE("OBJ: weights and colours behind a vertex are passed over", "[shape_io][obj]") {
  CHECK(obj("v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 1 1 0 1 .5 .5 .5\nv 0 1 0\nf 1 2 3 4\n") ==
        kTwoTriangles);
  check_malformed("v 0 0\n", "1", "3 numbers");
  check_malformed("v 0 0 0 1 2\n", "1", "not 5");
  check_malformed("v 0 0 0 1 2 3 4 5\n", "1", "not 8");
  check_malformed("v 0 0 0 x\n", "1", "'x' is not a number");
}

TEST_CASE("OBJ: ends of line, blanks, comments, a mark at the front", "[shape_io][obj]") {
  std::string text = "# a square\n\n" + kSquare + "\t f  1\t2 3   4  # a face\n";
  CHECK(obj(text) == kTwoTriangles);
  CHECK(obj("\xEF\xBB\xBF" + kSquare + "f 1 2 3 4\n") == kTwoTriangles);
  CHECK(obj("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4") == kTwoTriangles);
  for (const std::string end : {"\r\n", "\r", "\r\r\n"}) {
    std::string other;
    for (const char c : text)
      if (c == '\n')
        other += end;
      else
        other += c;
    CHECK(obj(other) == kTwoTriangles);
    other.resize(other.size() - end.size());
    CHECK(obj(other) == kTwoTriangles);
  }
  CHECK(obj("#" + std::string(500'000, 'x') + "\n" + kSquare + "f 1 2 3 4") == kTwoTriangles);
  CHECK(obj("# C:\\models\\\n" + kSquare + "f 1 2 3 4") == kTwoTriangles);
}

TEST_CASE("OBJ: a backslash joins lines", "[shape_io][obj]") {
  CHECK(obj("v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\\\n\\\r\n 3 4\n") == kTwoTriangles);
  CHECK(obj("v \\\n0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf \\\n1 2 3 4") == kTwoTriangles);
  CHECK(obj(kSquare + "f 1/ 2 \\\n3 4 #-------\n") == kTwoTriangles);  // both lines of 12
  check_malformed(kSquare + "f 1 2 \\\n", "5", "ends where the line should go on");
  check_malformed(kSquare + "f 1 2 \\\n x\n", "5", "'x' is not a corner");
}

TEST_CASE("OBJ: what is not geometry is passed over and never opened", "[shape_io][obj]") {
  CHECK(obj("mtllib ../../../../dev/zero\nmtllib /dev/zero\nusemtl a\ng b c\no d\ns 1\nvn nan 0 1\n"
            "vt 0\nvp 1 2\nl 1 2 99\np 1\ncstype bezier\nend\nunknown 1 2\nfo\nvx\n" +
            kSquare + "usemtl a\nf 1 2 3 4\n") == kTwoTriangles);
}

TEST_CASE("OBJ: points without faces are a shape of points", "[shape_io][obj]") {
  const Shape shape = obj(kSquare + "l 1 2\n");
  CHECK(shape.points.size() == 4);
  CHECK(shape.triangles.empty());
}

TEST_CASE("OBJ: faces of one or two corners cover nothing", "[shape_io][obj]") {
  CHECK(obj(kSquare + "f 1\nf 1 2\nf 1 2 3 4\n") == kTwoTriangles);
  check_malformed(kSquare + "f 1 9\n", "5", "9 is out of range");
  check_malformed(kSquare + "f\n", "5", "without numbers");
  check_malformed(kSquare + "f \n", "5", "without corners");
}

TEST_CASE("OBJ: indices that are wrong are refused with their line", "[shape_io][obj]") {
  check_malformed(kSquare + "f 1 2 3\nf 1 2 5\nf 1 2 3\n", "6", "5 is out of range, there are 4");
  check_malformed(kSquare + "f 1 2 0\n", "5", "vertex index 0");
  check_malformed(kSquare + "f -1 -2 -5\n", "5", "-5 is out of range");
  check_malformed("v 0 0 0\nf -1 -2 -3\nv 0 0 0\nv 0 0 0\n", "2", "-2 is out of range");
  check_malformed("f 1 2 3\n", "1", "there are 0 vertices");
  for (const std::string word :
       {"9223372036854775808", "4294967297", "2147483648", "-2147483649", "1.0", "1e0", "x", "1x",
        "+1", "1/x", "1/2/x", "1/2/3/4", "/1", "//1", "1,2", "-", "0x1", "1/9999999999999999999"}) {
    INFO(word);
    check_malformed(kSquare + "f 1 2 " + word + "\n", "5", "is not a corner");
  }
}

TEST_CASE("OBJ: numbers are whole words", "[shape_io][obj]") {
  const Shape shape = obj("v +1.5 -2e-3 .25\nv 1E2 5. +.5\nv 1e-400 -1e-99999999999999999999 0\n");
  CHECK(shape.points == std::vector<Vec3>{{1.5, -2e-3, .25}, {100, 5, .5}, {0, 0, 0}});
  for (const std::string word :
       {"1,5", "1.5x", "0x10", "--1", "+-1", "1e", "e5", "1.#QNAN", "-", "1d3"}) {
    INFO(word);
    check_malformed("v 0 0 " + word + "\n", "1", "is not a number");
  }
}

TEST_CASE("OBJ: numbers that are not finite count only where they are used", "[shape_io][obj]") {
  for (const std::string word :
       {"nan", "NaN", "-inf", "Infinity", "1e309", "-1e99999999999999999999"}) {
    INFO(word);
    const std::string text = kSquare + "f 1 2 3 4\nv 7 " + word + " 7\n";
    const Shape shape = obj(text);
    CHECK(shape.triangles == kTwoTriangles.triangles);
    CHECK(shape.points[4] == Vec3{});
    check_malformed(text + "f 1 2 5\n", "6", "not finite");
    check_malformed("v 0 " + word + " 0\n", "1", "not finite");  // in a cloud all points count
  }
  const double largest = std::numeric_limits<double>::max();
  CHECK(obj("v 1.7976931348623157e308 1e39 -5e-324\n").points[0] == Vec3{largest, 1e39, -5e-324});
}

TEST_CASE("OBJ: bytes that are no OBJ are refused", "[shape_io][obj]") {
  check_malformed(std::string("v 0 0 0\n\0\n", 10), "", "not a text");
  check_malformed(std::string("v\0 \0000\0", 6), "", "not a text");
  check_malformed("Hello, world!\nThis is a letter.\n", "", "no vertices");
  CHECK(refusal_of("", ShapeFormat::Obj).kind == ErrorKind::Empty);
  CHECK(refusal_of("# nothing\n\n", ShapeFormat::Obj).kind == ErrorKind::Empty);
  CHECK(refusal_of("\x1f\x8b\x08 v 0 0 0", ShapeFormat::Obj).says("gzip"));
  CHECK(refusal_of("\xff\xfev", ShapeFormat::Obj).says("UTF-16"));
}

TEST_CASE("OBJ: faces of more corners than a byte counts", "[shape_io][obj]") {
  std::ostringstream vertices, face;
  for (int i = 1; i <= 1000; ++i) {
    vertices << "v " << i << ' ' << i * i << " 0\n";
    face << ' ' << i;
  }
  CHECK(obj(vertices.str() + "f" + face.str()).triangles.size() == 998);
}

TEST_CASE("OBJ: concave faces do not leak", "[shape_io][obj]") {
  const Shape shape = obj("v 0 0 0\nv 3 -3 0\nv 1 0 0\nv 3 3 0\nf 1 2 3 4\nf 1 2 3\n");
  CHECK(shape.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
  const Shape turned = obj("v 0 0 0\nv 3 -3 0\nv 1 0 0\nv 3 3 0\nf 1 2 3\nf 2 3 4 1\n");
  CHECK(turned.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}, {2, 0, 1}});
}

TEST_CASE("OBJ: points of crossings come behind those of the file", "[shape_io][obj]") {
  const Shape shape = obj("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nf 1 2 3 4\nv 9 9 9\n");
  REQUIRE(shape.points.size() == 6);
  CHECK(shape.points[4] == Vec3{9, 9, 9});
  CHECK(length(shape.points[5] - Vec3{1, 1, 0}) < 1e-8);
  CHECK(shape.triangles.size() == 2);
}
