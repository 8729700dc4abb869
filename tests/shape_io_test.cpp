#include <marrow/file_io.hpp>
#include <marrow/shape_io.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "shape_text.hpp"

using namespace marrow;
namespace fs = std::filesystem;

namespace {

constexpr ShapeFormat kFormats[] = {ShapeFormat::Obj, ShapeFormat::Ply, ShapeFormat::Stl,
                                    ShapeFormat::Off};

const Shape kTetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                         {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

const fs::path kShared = fs::path(__FILE__).parent_path().parent_path().parent_path() / "shared";

/// Numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return (state_ >> 33) % n;
  }

 private:
  std::uint64_t state_;
};

/// `bytes` with one to four small wounds: bytes changed, cut out, doubled, or words put in.
std::string mutated(std::string bytes, Random& random) {
  static const std::string words[] = {"-1",
                                      "0",
                                      "99999999999999999999",
                                      "nan",
                                      "1e400",
                                      " ",
                                      "\n",
                                      "\\",
                                      "\r",
                                      "4294967295",
                                      "-5",
                                      "#",
                                      "/",
                                      "f ",
                                      std::string(1, '\0'),
                                      "\xff\xff\xff\xff",
                                      "v ",
                                      "3 ",
                                      "list "};
  for (std::size_t i = 1 + random.below(4); i > 0 && !bytes.empty(); --i) {
    const std::size_t at = random.below(bytes.size());
    const std::size_t size = 1 + random.below(std::min<std::size_t>(40, bytes.size() - at));
    switch (random.below(5)) {
      case 0:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        bytes.erase(at, size);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, size));
        break;
      case 3:
        bytes.insert(at, words[random.below(std::size(words))]);
        break;
      default:
        bytes.replace(at, std::min<std::size_t>(size, 4), words[random.below(std::size(words))]);
    }
  }
  return bytes;
}

/// Anything but a sound shape or an Error fails.
void check_mutations(const std::string& seed, ShapeFormat format, int count) {
  Random random(seed.size());
  int read = 0, refused = 0;
  for (int i = 0; i < count; ++i) {
    const std::string bytes = mutated(seed, random);
    try {
      if (!is_sound(parse_shape(bytes, format, "file")))
        FAIL("an unsound shape from mutation " << i);
      ++read;
    } catch (const Error& e) {
      if (e.kind() == ErrorKind::Internal || std::string(e.what()).find('\n') != std::string::npos)
        FAIL(e.what());
      ++refused;
    }
  }
  CHECK(read > 0);
  CHECK(refused > 0);
}

std::string text_ply() {
  return "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
         "property float z\nproperty list uchar int w\nelement face 2\n"
         "property list uchar int vertex_indices\nelement tristrips 1\n"
         "property list int int vertex_indices\nend_header\n0 0 0 0\n3 0 0 1 5\n3 1 0 0\n1 1 0 0\n"
         "1 3 0 2 1 1\n0 3 0 0\n6 0 1 2 3 4 5\n3 0 1 2\n5 0 1 2 -1 3\n";
}

std::string binary_ply(const std::string& order, bool big) {
  std::string bytes =
      "ply\nformat " + order +
      " 1.0\nelement vertex 6\nproperty short x\nproperty short y\nproperty short z\n"
      "element face 3\nproperty list uchar ushort vertex_indices\nend_header\n";
  const auto add = [&](int value) {
    const char low = static_cast<char>(value), high = static_cast<char>(value >> 8);
    bytes += big ? high : low;
    bytes += big ? low : high;
  };
  for (const int v : {0, 0, 0, 3, 0, 0, 3, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0}) add(v);
  for (const auto& face : {std::vector<int>{0, 1, 2, 3, 4, 5}, {0, 1, 2}, {0, 2, 1, 3}}) {
    bytes += static_cast<char>(face.size());
    for (const int v : face) add(v);
  }
  return bytes;
}

std::string text_stl() {
  std::string text = "solid t\n";
  for (const Triangle& t : kTetrahedron.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto i : t) {
      const Vec3& p = kTetrahedron.points[i];
      text += "vertex";
      for (const double x : {p.x, p.y, p.z}) (text += ' ') += std::to_string(x);
      text += '\n';
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

}  // namespace

TEST_CASE("shapes read back as they were written", "[shape_io]") {
  for (const ShapeFormat format : kFormats)
    CHECK(parse_shape(format_shape(kTetrahedron, format), format, "file").triangles.size() == 4);
  const double third = 1.0 / 3, least = std::numeric_limits<double>::denorm_min();
  const Shape exact{
      {{third, -third, 1e300}, {least, 0.1, 123456789.123456789}, {-0.0, 1, 2}, {7, 7, 7}},
      {{0, 1, 2}, {2, 1, 0}, {1, 1, 1}}};
  for (const ShapeFormat format : {ShapeFormat::Obj, ShapeFormat::Ply, ShapeFormat::Off})
    CHECK(parse_shape(format_shape(exact, format), format, "file") == exact);
}

TEST_CASE("shapes of points alone read back", "[shape_io]") {
  const Shape points{{{1, 2, 3}, {4, 5, 6}}, {}};
  for (const ShapeFormat format :
       {ShapeFormat::Obj, ShapeFormat::Ply, ShapeFormat::Off, ShapeFormat::Xyz})
    CHECK(parse_shape(format_shape(points, format), format, "file") == points);
}

TEST_CASE("the extension names the format of a shape", "[shape_io]") {
  CHECK(shape_format_of("a.b/X.OBJ") == ShapeFormat::Obj);
  CHECK(shape_format_of("x.ply") == ShapeFormat::Ply);
  CHECK(shape_format_of("x.Stl") == ShapeFormat::Stl);
  CHECK(shape_format_of("x.off") == ShapeFormat::Off);
  CHECK(shape_format_of("x.pcd") == ShapeFormat::Pcd);
  for (const std::string name : {"x.xyz", "x.PTS", "x.txt", "x.asc", "x.csv"})
    CHECK(shape_format_of(name) == ShapeFormat::Xyz);
  for (const std::string name : {"x", "", "x.glb", "x.gltf", "x.nrrd", "obj", ".obj"}) {
    try {
      shape_format_of(name);
      FAIL(name);
    } catch (const Error& e) {
      CHECK(e.kind() == ErrorKind::Unsupported);
      CHECK(std::string(e.what()).find("OBJ, PLY, STL, OFF, XYZ or PCD") != std::string::npos);
    }
  }
}

TEST_CASE("bytes without a name tell their format", "[shape_io]") {
  for (const ShapeFormat format : kFormats)
    CHECK(guess_shape_format(format_shape(kTetrahedron, format), "-") == format);
  CHECK(guess_shape_format(text_stl(), "-") == ShapeFormat::Stl);
  CHECK(guess_shape_format("\xEF\xBB\xBF# a\r\n\r\nCOFF 1 0 0", "-") == ShapeFormat::Off);
  CHECK(guess_shape_format("# a\nmtllib b\nv 0 0 0\n", "-") == ShapeFormat::Obj);
  CHECK(guess_shape_format("# a\n// b\n1 2 3 4\n", "-") == ShapeFormat::Xyz);
  CHECK(guess_shape_format("# .PCD v0.7\nVERSION 0.7\n", "-") == ShapeFormat::Pcd);
  for (const std::string bytes : {"", "hello", "{\"a\": 1}"})
    CHECK_THROWS_AS(guess_shape_format(bytes, "-"), Error);
}

TEST_CASE("files are written whole and read back", "[shape_io]") {
  const fs::path folder =
      fs::temp_directory_path() / ("marrow-shape-io-" + std::to_string(::getpid()));
  fs::create_directory(folder);
  for (const std::string name : {"t.obj", "t.ply", "t.off"}) {
    write_shape(folder / name, kTetrahedron);
    CHECK(read_shape(folder / name) == kTetrahedron);
  }
  CHECK_THROWS_AS(write_shape(folder / "t.stl", Shape{{{0, 0, 0}}, {}}), Error);
  CHECK_THROWS_AS(write_shape(folder / "t.glb", kTetrahedron), Error);
  CHECK_FALSE(fs::exists(folder / "t.stl"));
  CHECK_FALSE(fs::exists(folder / "t.glb"));
  CHECK_THROWS_AS(read_shape(folder / "nothing.obj"), Error);
  fs::remove_all(folder);
}

TEST_CASE("limits on bytes and triangles", "[shape_io]") {
  for (const ShapeFormat format : kFormats) {
    const std::string bytes = format_shape(kTetrahedron, format);
    CHECK(refusal_of(bytes, format, {bytes.size(), 4}).words.empty());
    CHECK(refusal_of(bytes, format, {bytes.size() - 1, 4}).kind == ErrorKind::Limit);
    CHECK(refusal_of(bytes, format, {bytes.size(), 3}).kind == ErrorKind::Limit);
  }
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  CHECK(refusal_of(quad, ShapeFormat::Obj, {1000, 1}).kind == ErrorKind::Limit);
  CHECK(refusal_of(quad, ShapeFormat::Obj, {1000, 2}).words.empty());
}

TEST_CASE("files of other kinds get a word that helps", "[shape_io]") {
  for (const ShapeFormat format : kFormats) {
    CHECK(refusal_of("", format).kind == ErrorKind::Empty);
    CHECK(refusal_of("\x1f\x8b\x08 and so on", format).says("gzip"));
    CHECK(refusal_of("PK\x03\x04 and so on", format).says("ZIP"));
    CHECK(refusal_of(std::string("\xff\xfev\0 \0", 6), format).says("UTF-16"));
    CHECK(refusal_of("glTF and so on", format).kind == ErrorKind::Unsupported);
  }
}

TEST_CASE("wounded files are shapes or errors", "[shape_io]") {
#ifdef MARROW_SANITIZE
  constexpr int kCount = 1500;
#else
  constexpr int kCount = 4000;
#endif
  for (const ShapeFormat format : kFormats)
    check_mutations(format_shape(kTetrahedron, format), format, kCount);
  check_mutations(
      "# o\nv 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0 1\nv 1 3 0 .5 .5 .5\nv 0 3 0\nvn 0 0 1\ng a\n"
      "f 1 2 3 4 5 6\nf 1/1 2/2 3/3\nf -6//1 -3//1 -5//1 \\\n -4//1\nl 1 2\nusemtl x\n",
      ShapeFormat::Obj, kCount);
  check_mutations(text_ply(), ShapeFormat::Ply, kCount);
  check_mutations(binary_ply("binary_little_endian", false), ShapeFormat::Ply, kCount);
  check_mutations(binary_ply("binary_big_endian", true), ShapeFormat::Ply, kCount);
  check_mutations(text_stl(), ShapeFormat::Stl, kCount);
  check_mutations(
      "OFF\n# a\n6 2 0\n0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 3 0\n0 3 0\n6 0 1 2 3 4 5\n"
      "3 0 1 2 255 0 0\n",
      ShapeFormat::Off, kCount);
}

TEST_CASE("bad files of the collection, where it is there", "[shape_io]") {
  // What readers have to refuse; shapes without an extent are refused later.
  const std::set<std::string> refused{"empty.obj",         "comments_only.obj", "garbage.obj",
                                      "nan_vertex.obj",    "index_oob.obj",     "index_neg_oob.obj",
                                      "index_zero.obj",    "index_2e63.obj",    "ply_count_4e9.ply",
                                      "ply_truncated.ply", "ply_list_neg.ply",  "png_as_ply.ply",
                                      "stl_count_max.stl", "off_huge.off"};
  if (!fs::exists(kShared / "badinputs")) {
    WARN("not there, not tested");
    return;
  }
  for (const auto& entry : fs::directory_iterator(kShared / "badinputs")) {
    const std::string name = entry.path().filename();
    INFO(name);
    const std::string extension = extension_of(name);
    const bool ours = extension == "obj" || extension == "ply" || extension == "stl" ||
                      extension == "off" || extension == "xyz";
    try {
      const Shape shape = read_shape(entry.path());
      CHECK(is_sound(shape));
      CHECK((ours && refused.count(name) == 0));
    } catch (const Error& e) {
      INFO(e.what());
      CHECK((ours ? refused.count(name) == 1 : e.kind() == ErrorKind::Unsupported));
    }
  }
}

TEST_CASE("all meshes of the collection, where it is there", "[shape_io]") {
  if (!fs::exists(kShared / "meshes")) {
    WARN("not there, not tested");
    return;
  }
  for (const auto& entry : fs::recursive_directory_iterator(kShared / "meshes")) {
    const std::string extension = extension_of(entry.path());
    if (extension != "obj" && extension != "ply") continue;
#ifdef MARROW_SANITIZE
    if (entry.file_size() > 1'000'000) continue;
#endif
    INFO(entry.path());
    CHECK(is_sound(read_shape(entry.path())));
  }
}
