// Point clouds from files.
#include <marrow/shape_io.hpp>

#include <cstring>

#include "random.hpp"
#include "shape_text.hpp"

using namespace marrow;
using test::Random;

namespace {

Shape xyz(std::string_view bytes) { return parse_shape(bytes, ShapeFormat::Xyz, "file"); }
Shape pcd(std::string_view bytes) { return parse_shape(bytes, ShapeFormat::Pcd, "file"); }

const Shape kTwoPoints{{{1, 2, 3}, {-4, 0.5, 6}}, {}};

const std::string kPcd =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x rgb y z n\n"
    "SIZE 4 4 8 2 1\nTYPE F U F I U\nCOUNT 1 1 1 1 3\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

template <class Number>
void append(std::string& bytes, Number value) {
  char buffer[sizeof value];
  std::memcpy(buffer, &value, sizeof value);
  bytes.append(buffer, sizeof buffer);
}

std::string binary_pcd() {
  std::string bytes = kPcd + "DATA binary\n";
  for (const Vec3& p : kTwoPoints.points) {
    append(bytes, static_cast<float>(p.x));
    append(bytes, std::uint32_t{0xff00ff});
    append(bytes, p.y);
    append(bytes, static_cast<std::int16_t>(p.z));
    bytes += "abc";
  }
  return bytes;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("points are read whatever stands between and behind their numbers", "[shape_xyz]") {
  for (const std::string text :
       {"1 2 3\n-4 0.5 6\n", "1 2 3 0 0 1\n-4 0.5 6 255 0 0 word",
        "\n# a\n// b\n1\t2  3 # c\r\n-4 .5 6", "1,2,3\n-4, 0.5 ,6,9", "1;2;3;\n-4;0.5;6",
        "2\n1 2 3 7\n-4 0.5 6 8\n", "2\n1,2,3\n-4,0.5,6\n", "x y z\n1 2 3\n-4 0.5 6\n",
        "X,Y,Z,R,G,B\n1,2,3,0,0,0\n-4,0.5,6,0,0,0\n", "\"x\",\"y\",\"z\"\n1,2,3\n-4,0.5,6\n",
        "\xEF\xBB\xBF"
        "1e0 +2 3\n-4 5e-1 6"}) {
    INFO(text);
    CHECK(xyz(text) == kTwoPoints);
  }
}

TEST_CASE("bad points are refused by their line", "[shape_xyz]") {
  const auto refused = [](const std::string& text, const std::string& place, const char* part) {
    check_malformed(text, ShapeFormat::Xyz, place, part);
  };
  refused("1 2 3\n4 5\n", "2", "fewer than 3");
  refused("1 2 3\n4 5 z\n", "2", "'z'");
  refused("1 2 3\n4 5 6x\n", "2", "'6x'");
  refused("1,5 2,5 3,5\n", "1", "'5 2'");
  refused("1,5;2,5;3,5\n", "1", "'1,5'");
  refused("a b c\n1 2 3\n", "1", "'a'");
  refused("1 2 3\nx y z\n", "2", "'x'");
  refused("3\n1 2 3\n4 5 6\n", "3", "2 of the 3");
  refused("1\n1 2 3\n4 5 6\n", "3", "too small");
  refused("18446744073709551615\n1 2 3\n", "2", "1 of the 18446744073709551615");
  refused("# a\n1 2 3\nnan 5 6\n", "3", "not finite");
  refused("1 2 1e999\n", "1", "not finite");
  refused(std::string("1 2 3\n\0", 7), "", "control characters");
  for (const std::string nothing : {"", "# a\n", "0\n", "x y z\n"})
    CHECK(refusal_of(nothing, ShapeFormat::Xyz).kind == ErrorKind::Empty);
}

TEST_CASE("an XYZ holds points and nothing else", "[shape_xyz]") {
  const Shape exact{{{1.0 / 3, -0.1, 1e300}, {5e-324, 0, 7}}, {}};
  CHECK(xyz(format_shape(exact, ShapeFormat::Xyz)) == exact);
  CHECK_THROWS_AS(format_shape({{{0, 0, 0}}, {{0, 0, 0}}}, ShapeFormat::Xyz), Error);
  CHECK_THROWS_AS(format_shape(exact, ShapeFormat::Pcd), Error);
}

TEST_CASE("PCD is read as text and as binary", "[shape_pcd]") {
  CHECK(pcd(kPcd + "DATA ascii\n1 9 2 3 1 1 1\n-4 9 0.5 6 1 1 1\n") == kTwoPoints);
  CHECK(pcd(binary_pcd()) == kTwoPoints);
  CHECK(pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nDATA ascii\n"
            "1 2 3\nnan nan nan\n-4 0.5 6\nnan nan nan\n") == kTwoPoints);
}

TEST_CASE("bad PCD files are refused by their place", "[shape_pcd]") {
  const auto refused = [](const std::string& text, const std::string& place, const char* part) {
    check_malformed(text, ShapeFormat::Pcd, place, part);
  };
  const std::string text = kPcd + "DATA ascii\n1 9 2 3 1 1 1\n-4 9 0.5 6 1 1 1\n";
  refused(replaced(text, "FIELDS x rgb y z", "FIELDS x rgb y w"), "header", "'z'");
  refused(replaced(text, "SIZE 4 4 8 2", "SIZE 4 4 8 3"), "header", "'z'");
  refused(replaced(text, "TYPE F", "TYPE G"), "5", "'G'");
  refused(replaced(text, "WIDTH 2", "WIDTH 3"), "11", "width of 3");
  refused(replaced(text, "WIDTH 2", "WIDTH two"), "7", "width");
  refused(replaced(text, "VERSION", "VERTION"), "2", "'VERTION'");
  refused(replaced(text, "DATA ascii", "DATA text"), "11", "'text'");
  refused(replaced(text, "9 0.5", "9 half"), "13", "'half'");
  refused(replaced(text, "9 0.5 6 1 1 1", "9 0.5000000000000"), "13", "fewer values");
  refused(text + "1 1 1 1 1 1 1\n", "14", "goes on");
  refused(replaced(text, "2 3 1 1 1\n-4 9 0.5 6 1 1 1", "2 3 1 1.000000000000000 1"), "12",
          "1 of 2");
  refused(replaced(text, "\n-4 9 0.5 6 1 1 1", ""), "header", "counts 2 points");
  refused(replaced(replaced(text, "WIDTH 2", "WIDTH 4294967295"), "POINTS 2", "POINTS 4294967295"),
          "header", "4294967295 points");
  refused("FIELDS x y z\n", "1", "DATA");
  CHECK(refusal_of(replaced(text, "DATA ascii", "DATA binary_compressed"), ShapeFormat::Pcd).kind ==
        ErrorKind::Unsupported);
  CHECK(refusal_of("FIELDS x y z\nPOINTS 0\nDATA ascii\n", ShapeFormat::Pcd).kind ==
        ErrorKind::Empty);
  const std::string binary = binary_pcd();
  for (std::size_t size = 0; size < binary.size(); ++size)
    CHECK(refusal_of(binary.substr(0, size), ShapeFormat::Pcd).kind.has_value());
}

TEST_CASE("wounded clouds are refused or sound", "[shape_xyz][shape_pcd]") {
  Random random(7);
  for (const auto& [bytes, format] :
       {std::pair{std::string("2\n1,2,3\n-4,0.5,6\n"), ShapeFormat::Xyz},
        {std::string("x y z\n1 2 3 # a\n-4 0.5 6 9\n"), ShapeFormat::Xyz},
        {kPcd + "DATA ascii\n1 9 2 3 1 1 1\n-4 9 0.5 6 1 1 1\n", ShapeFormat::Pcd},
        {binary_pcd(), ShapeFormat::Pcd}})
    for (int i = 0; i < 3000; ++i) {
      std::string wounded = bytes;
      for (std::uint32_t k = 0; k <= random.below(3); ++k) {
        const std::size_t at = random.below(static_cast<std::uint32_t>(wounded.size()));
        wounded[at] = static_cast<char>(random.below(256));
      }
      if (random.below(4) == 0)
        wounded.resize(random.below(static_cast<std::uint32_t>(wounded.size())));
      try {
        const Shape shape = parse_shape(wounded, format, "file");
        CHECK(is_sound(shape));
      } catch (const Error& e) {
        CHECK(e.kind() != ErrorKind::Internal);
      }
    }
}
