#include <marrow/error.hpp>
#include <marrow/skeleton_io.hpp>

#include <cstdio>
#include <filesystem>
#include <limits>

#include "catch.hpp"
#include "skeleton_text.hpp"

using namespace marrow;
using test::error_of;

namespace {

const auto formats = {SkeletonFormat::Obj, SkeletonFormat::Skel, SkeletonFormat::Ply,
                      SkeletonFormat::Json};

/// A ring with a tail, a part of its own, and numbers that need all their digits.
CurveSkeleton sample() {
  CurveSkeleton s;
  s.nodes = {{{0.1, -0.0, 1e-300}, 1.0 / 3},         {{1, 0, 0}, 0.25}, {{0, 1, 1e300}, 5e-324},
             {{2.0 / 3, 1e22, 123456789.125}, 1e17}, {{-7, -8, -9}, 2}, {{-6, -8, -9}, 2}};
  s.edges = {{0, 1}, {0, 2}, {1, 2}, {2, 3}, {4, 5}};
  return s;
}

const std::string skel_header = "ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST\n";

const std::string ply_header =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
    "property double z\nproperty double radius\nelement edge 1\nproperty int vertex1\n"
    "property int vertex2\nend_header\n";

std::string json_of(const std::string& nodes, const std::string& edges) {
  return R"({"format": "marrow-skeleton", "version": 1, "nodes": )" + nodes + R"(, "edges": )" +
         edges + "}";
}

}  // namespace

TEST_CASE("every format reads back to the same bits", "[skeleton_io]") {
  for (const auto format : formats) {
    CHECK(parse_skeleton(format_skeleton(sample(), format), format, "f") == sample());
    CHECK(parse_skeleton(format_skeleton({}, format), format, "f") == CurveSkeleton{});
  }
}

TEST_CASE("a node without an edge survives in every format", "[skeleton_io]") {
  const CurveSkeleton one{{{{1, 2, 3}, 4}}, {}};
  for (const auto format : formats)
    CHECK(parse_skeleton(format_skeleton(one, format), format, "f") == one);
}

TEST_CASE("the texts are these", "[skeleton_io]") {
  const CurveSkeleton s{{{{0, 0.5, 1e9}, 2}, {{1, 0, -0.1}, 1}}, {{0, 1}}};
  CHECK(format_skeleton(s, SkeletonFormat::Obj) ==
        "# marrow curve-skeleton: v x y z radius, l i j\n"
        "v 0 0.5 1e+09 2\nv 1 0 -0.1 1\nl 1 2\n");
  CHECK(format_skeleton(s, SkeletonFormat::Skel) ==
        skel_header + "2\n0 0 0.5 1e+09 2 1 1 \n1 1 0 -0.1 1 1 0 \n");
  CHECK(format_skeleton(s, SkeletonFormat::Ply) ==
        "ply\nformat ascii 1.0\ncomment marrow curve-skeleton\nelement vertex 2\n"
        "property double x\nproperty double y\nproperty double z\nproperty double radius\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
        "0 0.5 1e+09 2\n1 0 -0.1 1\n0 1\n");
  CHECK(format_skeleton(s, SkeletonFormat::Json) ==
        "{\n  \"format\": \"marrow-skeleton\",\n  \"version\": 1,\n"
        "  \"units\": \"of the shape\",\n"
        "  \"counts\": {\"nodes\": 2, \"edges\": 1, \"components\": 1, \"cycles\": 0, "
        "\"leaves\": 2, \"joints\": 0},\n"
        "  \"nodes\": [\n    [0, 0.5, 1e+09, 2],\n    [1, 0, -0.1, 1]\n  ],\n"
        "  \"edges\": [\n    [0, 1]\n  ]\n}\n");
}

TEST_CASE("what is not finite is not written", "[skeleton_io]") {
  const double infinity = std::numeric_limits<double>::infinity();
  const CurveSkeleton place{{{{infinity, 0, 0}, 1}}, {}}, radius{{{{0, 0, 0}, infinity}}, {}};
  for (const auto format : formats) {
    CHECK_THROWS_AS(format_skeleton(place, format), Error);
    CHECK_THROWS_AS(format_skeleton(radius, format), Error);
  }
}

TEST_CASE("the files of others are read", "[skeleton_io]") {
  const CurveSkeleton path{{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}}, {{0, 1}, {1, 2}}};
  // Polylines, negative indices, an edge twice, groups, CR LF, a byte order mark, a leading plus.
  CHECK(parse_skeleton("\xEF\xBB\xBF# x\r\no tree\r\nv 0 0 0 1\r\nv +1 0 0 1\r\n\r\nv 2 0 0 1.0\r\n"
                       "l 1 2 3\r\nl -2 -3",
                       SkeletonFormat::Obj, "f") == path);
  // Gaps in the ids, an edge at one end only.
  CHECK(parse_skeleton(skel_header + "3\n10 0 0 0 1.000000 1 30\n30 1 0 0 1 2 10 20\n20 2 0 0 1 0",
                       SkeletonFormat::Skel, "f") == path);
  // Another order of properties, more properties, another element.
  CHECK(parse_skeleton("ply\nformat ascii 1.0\nelement edge 2\nproperty uchar red\n"
                       "property int vertex2\nproperty int vertex1\nelement vertex 3\n"
                       "property float32 radius\nproperty float z\nproperty float y\n"
                       "property float x\nelement face 1\n"
                       "property list uchar int vertex_indices\nend_header\n"
                       "255 0 1\n0 2 1\n1 0 0 0\n1 0 0 1\n1 0 0 2\n3 0 1 2\n",
                       SkeletonFormat::Ply, "f") == path);
  CHECK(parse_skeleton(R"({"edges": [[2, 1], [1, 0], [0, 1]], "later": {"a": [1]}, "version": 1,
                           "nodes": [[0, 0, 0, 1], [1, 0, 0, 1], [2.0, 0, 0, 1]],
                           "format": "marrow-skeleton"})",
                       SkeletonFormat::Json, "f") == path);
}

TEST_CASE("a malformed OBJ is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Obj); };
  CHECK(error("v 0 0\n") == "f:1: a node is 'v x y z radius'; this line has 2 numbers");
  CHECK(error("v 0 0 0\n") ==
        "f:1: a node without a radius; give one for all that have none (marrow convert --radius "
        "R)");
  CHECK(error("\nv 0 0 0 0\n") == "f:2: the radius '0' is not greater than 0");
  CHECK(error("v 0 0 0 -1\n") != "");
  CHECK(error("v 0 0 nan 1\n") == "f:1: 'nan' is not a finite number");
  CHECK(error("v 0 0 inf 1\n") != "");
  CHECK(error("v 0 0 1e999 1\n") != "");
  CHECK(error("v 0 0 1,5 1\n") != "");
  CHECK(error("v 0 0 0x1 1\n") != "");
  CHECK(error("v 0 0 +-1 1\n") != "");
  const std::string two = "v 0 0 0 1\nv 1 0 0 1\n";
  CHECK(error(two + "l 1 3\n") == "f:3: vertex index 3 is out of range 1..2");
  CHECK(error(two + "l 1 0\n") != "");
  CHECK(error(two + "l 1 -3\n") != "");
  CHECK(error(two + "l 1 9223372036854775808\n") != "");
  CHECK(error(two + "l 1 4294967298\n") != "");
  CHECK(error(two + "l 1 1.5\n") != "");
  CHECK(error(two + "l 1\n") != "");
  CHECK(error(two + "l 2 2\n") == "f:3: an edge from a node to itself");
  CHECK(error(two + "f 1 2 2\n") == "f:3: a face: this is a shape, not a curve-skeleton");
  CHECK(error(std::string("\x1F\x8B\n\0v", 5)) != "");
}

TEST_CASE("a malformed SKEL is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Skel); };
  CHECK(error("") != "");
  CHECK(error("ID x y z\n0\n") != "");
  CHECK(error(skel_header) != "");
  CHECK(error(skel_header + "4000000000000\n0 0 0 0 1 0 \n") ==
        "f:2: the file claims 4000000000000 nodes and is too short for them");
  CHECK(error(skel_header + "2\n0 0 0 0 1 0 \n") == "f:3: the file ends before node 2 of 2");
  CHECK(error(skel_header + "1\n0 0 0 0 1 0 \n0 0 0 0 1 0 \n") != "");
  CHECK(error(skel_header + "1\n0 0 0 0 1 2 1 \n") ==
        "f:3: the line claims 2 neighbours and lists 1");
  CHECK(error(skel_header + "1\n0 0 0 0 1 1 7 \n") == "f:3: neighbour 7 is no id of this file");
  CHECK(error(skel_header + "1\n0 0 0 0 1 1 0 \n") == "f:3: an edge from a node to itself");
  CHECK(error(skel_header + "2\n5 0 0 0 1 0 \n5 0 0 0 1 0 \n") != "");
  CHECK(error(skel_header + "1\n0 0 0 0\n") != "");
}

TEST_CASE("a malformed PLY is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Ply); };
  const std::string nodes = "0 0 0 1\n1 0 0 1\n";
  CHECK(error(ply_header + nodes + "0 1\n") == "");
  CHECK(error(ply_header + nodes + "0 2\n") == "f:14: vertex index 2 is not below 2");
  CHECK(error(ply_header + nodes + "0 -1\n") != "");
  CHECK(error(ply_header + nodes + "0 0\n") != "");
  CHECK(error(ply_header + nodes + "0\n") != "");
  CHECK(error(ply_header + nodes) == "f:13: the file ends before edge 1 of 1");
  CHECK(error(ply_header + nodes + "0 1\n0 1\n") != "");
  CHECK(error(ply_header + "0 0 0 1 1\n1 0 0 1\n0 1\n") != "");
  CHECK(error("") != "");
  CHECK(error("ply\nformat ascii 1.0\n") != "");
  CHECK(error("ply\nformat ascii 1.0\nproperty int x\nend_header\n") != "");
  CHECK(error("ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty double x\n"
              "property double y\nproperty double z\nproperty double radius\nend_header\n") != "");
  CHECK(error("ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
              "property double z\nend_header\n0 0 0\n")
            .starts_with("f:8: a node without a radius"));
  CHECK(error("ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
              "end_header\n0 0\n") == "f:6: the element 'vertex' has no property 'z'");
  CHECK(error_of("ply\nformat binary_little_endian 1.0\nend_header\n", SkeletonFormat::Ply,
                 ErrorKind::Unsupported) != "");
}

TEST_CASE("a malformed JSON is refused with its place", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Json); };
  CHECK(error("") != "");
  CHECK(error("[]") != "");
  CHECK(error("{\n\"a\": \n}").find("line 3") != std::string::npos);
  CHECK(error("{}") != "");
  CHECK(error(R"({"format": "marrow-skeleton"})") != "");
  CHECK(error(std::string(1'000'000, '[')).find("nested") != std::string::npos);
  CHECK(error(json_of("[[0, 0, 0, 1]]", "[]")) == "");
  CHECK(error(json_of("[[0, 0, 0]]", "[]")) == "f: nodes[0]: is not [x, y, z, radius]");
  CHECK(error(json_of("[[0, 0, 0, null]]", "[]")) != "");
  CHECK(error(json_of("[[0, 0, 0, 0]]", "[]")) != "");
  CHECK(error(json_of("[[0, 0, 1e999, 1]]", "[]")) != "");
  CHECK(error(json_of("[[0, 0, NaN, 1]]", "[]")) != "");
  CHECK(error(json_of("7", "[]")) == "f: nodes: is not an array");
  const std::string two = "[[0, 0, 0, 1], [1, 0, 0, 1]]";
  CHECK(error(json_of(two, "[[0, 2]]")) ==
        "f: edges[0]: has a node that is not an integer below 2");
  CHECK(error(json_of(two, "[[0, -1]]")) != "");
  CHECK(error(json_of(two, "[[0, 1.0]]")) != "");
  CHECK(error(json_of(two, "[[0, 4294967297]]")) != "");
  CHECK(error(json_of(two, "[[1, 1]]")) != "");
  CHECK(error(json_of(two, "[[0]]")) != "");
  CHECK(error_of(R"({"format": "marrow-skeleton", "version": 3})", SkeletonFormat::Json,
                 ErrorKind::Unsupported) != "");
}

TEST_CASE("no prefix of a file is read as the whole", "[skeleton_io]") {
  for (const auto format : {SkeletonFormat::Skel, SkeletonFormat::Ply, SkeletonFormat::Json}) {
    const std::string text = format_skeleton(sample(), format);
    const auto end = text.find_last_not_of(" \n");
    for (std::size_t n = 0; n < end; ++n) {
      INFO(text.substr(0, n));
      CHECK_THROWS_AS(parse_skeleton(text.substr(0, n), format, "f"), Error);
    }
  }
}

TEST_CASE("the extension names the format", "[skeleton_io]") {
  CHECK(skeleton_format_of("a/b.OBJ") == SkeletonFormat::Obj);
  CHECK(skeleton_format_of("b.skel") == SkeletonFormat::Skel);
  CHECK(skeleton_format_of("b.ply") == SkeletonFormat::Ply);
  CHECK(skeleton_format_of("b.json") == SkeletonFormat::Json);
  CHECK_THROWS_AS(skeleton_format_of("b.stl"), Error);
  CHECK_THROWS_AS(skeleton_format_of("obj"), Error);
}

TEST_CASE("files go out and come back", "[skeleton_io]") {
  const auto folder = std::filesystem::temp_directory_path() / "marrow_skeleton_io_test";
  std::filesystem::create_directories(folder);
  for (const char* name : {"s.obj", "s.skel", "s.ply", "s.json"}) {
    write_skeleton((folder / name).string(), sample());
    CHECK(read_skeleton((folder / name).string()) == sample());
  }
  CHECK_THROWS_AS(read_skeleton((folder / "none.obj").string()), Error);
  std::filesystem::remove_all(folder);
}
