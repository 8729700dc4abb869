#include <marrow/shape_io.hpp>

#include <limits>

#include "shape_text.hpp"

using namespace marrow;

namespace {

Shape stl(std::string_view bytes) { return parse_shape(bytes, ShapeFormat::Stl, "file"); }
Shape off(std::string_view bytes) { return parse_shape(bytes, ShapeFormat::Off, "file"); }

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "  facet normal nan -nan(ind) 0\n    outer loop\n      vertex " + a + "\n      vertex " +
         b + "\n      vertex " + c + "\n    endloop\n  endfacet\n";
}

const std::string kTextStl = "solid a name of words\n" + facet("0 0 0", "1 0 0", "1 1 0") +
                             facet("0 0 0", "1 1 -0.0", "0 1 0") + "endsolid a name of words\n";
const Shape kTwoTriangles{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
const std::string kOff = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

std::string with_header(std::string bytes, const std::string& header) {
  return bytes.replace(0, header.size(), header);
}

}  // namespace

TEST_CASE("STL: text, equal vertices become one", "[shape_io][stl]") {
  CHECK(stl(kTextStl) == kTwoTriangles);
  CHECK(stl("\n  " + replaced(kTextStl, "facet normal", "FACET\tNormal")) == kTwoTriangles);
  CHECK(stl("solid\n" + facet("0 0 0", "1 0 0", "1 1 0") + "endsolid\nsolid b\n" +
            facet("0 0 0", "1 1 0", "0 1 0") + "endsolid b") == kTwoTriangles);
  std::string crlf;
  for (const char c : kTextStl) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(stl(crlf) == kTwoTriangles);
  const std::string quad =
      replaced(replaced(kTextStl, "vertex 1 1 0\n", "vertex 1 1 0\n vertex 0 1 0\n"),
               facet("0 0 0", "1 1 -0.0", "0 1 0"), "");
  CHECK(stl(quad) == kTwoTriangles);
}

TEST_CASE("STL: binary, also with a header that begins like a text", "[shape_io][stl]") {
  const std::string bytes = format_shape(kTwoTriangles, ShapeFormat::Stl);
  CHECK(bytes.size() == 84 + 2 * 50);
  CHECK(stl(bytes) == kTwoTriangles);
  CHECK(stl(with_header(bytes, "solid made by a machine\n")) == kTwoTriangles);
  CHECK(stl(bytes + "a tail") == kTwoTriangles);
}

TEST_CASE("STL: counts that lie are refused", "[shape_io][stl]") {
  const std::string bytes = format_shape(kTwoTriangles, ShapeFormat::Stl);
  const auto with_count = [&](const std::string& count) {
    std::string other = bytes;
    return other.replace(80, 4, count);
  };
  for (const std::string& count : {std::string("\xff\xff\xff\xff"), std::string("\3\0\0\0", 4),
                                   std::string("\1\0\0\0", 4), std::string("\0\0\0\0", 4)}) {
    check_malformed(with_count(count), ShapeFormat::Stl, "header", "room for 2");
    check_malformed(with_header(with_count(count), "solid x\n"), ShapeFormat::Stl, "header",
                    "room for 2");
  }
  for (std::size_t size = 1; size < bytes.size(); ++size)
    CHECK(refusal_of(bytes.substr(0, size), ShapeFormat::Stl).kind == ErrorKind::Malformed);
  check_malformed("hello", ShapeFormat::Stl, "", "neither");
}

TEST_CASE("STL: a text that is cut anywhere is refused", "[shape_io][stl]") {
  const std::size_t end = kTextStl.find("endsolid") + 8;
  for (std::size_t size = 0; size < end; ++size) {
    INFO(size);
    CHECK(refusal_of(kTextStl.substr(0, size), ShapeFormat::Stl).kind.has_value());
  }
  check_malformed(kTextStl.substr(0, kTextStl.find("endsolid")), ShapeFormat::Stl, "15",
                  "cut short");
}

TEST_CASE("STL: texts that are wrong", "[shape_io][stl]") {
  check_malformed(replaced(kTextStl, "1 1 0", "1 1 x"), ShapeFormat::Stl, "6", "'x'");
  check_malformed(replaced(kTextStl, "1 1 0\n", "1 1\n"), ShapeFormat::Stl, "7", "'endloop'");
  check_malformed(replaced(kTextStl, "outer", "inner"), ShapeFormat::Stl, "3", "'inner'");
  check_malformed(replaced(kTextStl, "endfacet", "endface"), ShapeFormat::Stl, "8", "'endface'");
  check_malformed(replaced(kTextStl, "1 1 0", "1 inf 0"), ShapeFormat::Stl, "6", "not finite");
  check_malformed(kTextStl + "more", ShapeFormat::Stl, "17", "'more'");
  CHECK(refusal_of("solid x\nendsolid x\n", ShapeFormat::Stl).kind == ErrorKind::Empty);
  CHECK(refusal_of(std::string(84, '\0'), ShapeFormat::Stl).kind == ErrorKind::Empty);
}

TEST_CASE("STL: what it cannot hold is not written", "[shape_io][stl]") {
  const auto kind = [](const Shape& shape) {
    try {
      format_shape(shape, ShapeFormat::Stl);
    } catch (const Error& e) {
      return e.kind();
    }
    return ErrorKind::Internal;
  };
  CHECK(kind({{{0, 0, 0}}, {}}) == ErrorKind::Unsupported);
  CHECK(kind({{{1e39, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}) == ErrorKind::Unsupported);
  // Normals of triangles without area, or too large for their products, are 0.
  const Shape line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  CHECK(stl(format_shape(line, ShapeFormat::Stl)) == line);
}

TEST_CASE("OFF: counts on a line of their own, behind the header, or without it",
          "[shape_io][off]") {
  CHECK(off(kOff) == kTwoTriangles);
  CHECK(off(replaced(kOff, "OFF\n", "OFF ")) == kTwoTriangles);
  CHECK(off(replaced(kOff, "OFF\n", "")) == kTwoTriangles);
  CHECK(off(replaced(kOff, "4 2 0", "4 2")) == kTwoTriangles);
  CHECK(off("# first\n" + replaced(kOff, "4 2 0", "\n# then\n4 2 0 # counts\n")) == kTwoTriangles);
  CHECK(off(replaced(replaced(kOff, "4 2 0", "4 1 0"), "3 0 1 2\n3 0 2 3", "4 0 1 2 3")) ==
        kTwoTriangles);
}

TEST_CASE("OFF: normals and colours are passed over", "[shape_io][off]") {
  for (const std::string header : {"COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"})
    CHECK(off(header + "\n4 2 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n"
                       "3 0 1 2 255 0 0\n3 0 2 3 0.5 0.5 0.5 1\n") == kTwoTriangles);
  for (const std::string header : {"4OFF", "nOFF", "XOFF", "OFF BINARY", "COFF BINARY"})
    CHECK(refusal_of(header + "\n4 2 0\n" + std::string(3, '\0'), ShapeFormat::Off).kind ==
          (header.ends_with("BINARY") ? ErrorKind::Unsupported : ErrorKind::Malformed));
  CHECK(refusal_of("4OFF\n1 0 0\n0 0 0 1\n", ShapeFormat::Off).kind == ErrorKind::Unsupported);
}

TEST_CASE("OFF: points without faces are a shape of points", "[shape_io][off]") {
  CHECK(off("OFF\n2 0 0\n1 2 3\n4 5 6\n") == Shape{{{1, 2, 3}, {4, 5, 6}}, {}});
  CHECK(refusal_of("OFF\n0 0 0\n", ShapeFormat::Off).kind == ErrorKind::Empty);
}

TEST_CASE("OFF: files that are wrong", "[shape_io][off]") {
  const auto bad = [](std::string_view what, std::string_view by, const std::string& place,
                      std::string_view part) {
    check_malformed(replaced(kOff, what, by), ShapeFormat::Off, place, part);
  };
  bad("OFF", "OBJ", "1", "'OFF'");
  bad("4 2 0", "2000000000 2000000000 0", "2", "2000000000");
  bad("4 2 0", "18446744073709551615 18446744073709551615 0", "2", "bytes follow");
  bad("4 2 0", "99999999999999999999 2 0", "2", "count of vertices");
  bad("4 2 0", "-4 2 0", "2", "count of vertices");
  bad("4 2 0", "4", "2", "count of faces");
  bad("4 2 0", "4 3 0", "8", "last face");
  bad("4 2 0", "4 1 0", "8", "goes on");
  bad("1 1 0", "1 1", "5", "fewer than 3");
  bad("1 1 0", "1 1 x", "5", "'x'");
  bad("1 1 0", "1 1 1.#QNAN", "5", "'1.#QNAN'");
  bad("1 1 0", "1 nan 0", "5", "not finite");
  bad("3 0 1 2", "3 0 1", "7", "fewer corners");
  bad("3 0 1 2", "3 0 1 4", "7", "4 is out of range");
  bad("3 0 1 2", "3 0 1 -1", "7", "-1 is out of range");
  bad("3 0 1 2", "3 0 1 1.5", "7", "'1.5'");
  bad("3 0 1 2", "-3 0 1 2", "7", "'-3'");
  bad("3 0 1 2", "4000000000 0 1 2", "7", "4000000000 corners");
  for (std::size_t size = 0; size < kOff.size() - 2; ++size)
    CHECK(refusal_of(kOff.substr(0, size), ShapeFormat::Off).kind.has_value());
}
