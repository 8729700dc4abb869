// What goes out comes back, for every format; and the formats of lines that are not in
// skeleton_io_test.cpp.
#include <marrow/error.hpp>
#include <marrow/skeleton_io.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "random_skeleton.hpp"
#include "skeleton_faults.hpp"
#include "skeleton_text.hpp"

using namespace marrow;
using test::error_of;
using test::random_skeleton;

namespace {

constexpr std::uint64_t kGraphs = 200;

const auto exact_formats = {SkeletonFormat::Skel,  SkeletonFormat::Cg,      SkeletonFormat::Ply,
                            SkeletonFormat::Obj,   SkeletonFormat::Json,    SkeletonFormat::Vtp,
                            SkeletonFormat::Graph, SkeletonFormat::GraphMl, SkeletonFormat::Csv};
const auto formats_with_sections = {SkeletonFormat::Ply, SkeletonFormat::Json, SkeletonFormat::Vtp,
                                    SkeletonFormat::GraphMl, SkeletonFormat::Csv};

CurveSkeleton read(const std::string& text, SkeletonFormat format, double radius = 0) {
  return parse_skeleton(text, format, "f", radius);
}

CurveSkeleton without_sections(CurveSkeleton skeleton) {
  for (auto& node : skeleton.nodes) node.section_radius = 0;
  return skeleton;
}

/// Edges as places, so that the order of nodes does not count.
std::multiset<std::array<double, 6>> lines_of(const CurveSkeleton& s) {
  std::multiset<std::array<double, 6>> lines;
  for (const auto& [a, b] : s.edges) {
    Vec3 p = s.nodes[a].position, q = s.nodes[b].position;
    if (p.x > q.x) std::swap(p, q);
    lines.insert({p.x, p.y, p.z, q.x, q.y, q.z});
  }
  return lines;
}

std::multiset<std::array<double, 4>> balls_of(const CurveSkeleton& s) {
  std::multiset<std::array<double, 4>> balls;
  for (const auto& n : s.nodes) balls.insert({n.position.x, n.position.y, n.position.z, n.radius});
  return balls;
}

/// What the validators of SWC ask: ids from 1 in steps of 1, a parent before its child, radii.
std::string swc_fault(const std::string& text) {
  std::istringstream lines(text);
  long last = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    std::istringstream words(line);
    long id = 0, type = 0, parent = 0;
    double x = 0, y = 0, z = 0, radius = 0;
    std::string more;
    if (!(words >> id >> type >> x >> y >> z >> radius >> parent) || words >> more)
      return "not seven numbers: " + line;
    if (id != ++last) return "an id out of order: " + line;
    if (parent != -1 && (parent < 1 || parent >= id)) return "no parent before it: " + line;
    if (!(radius > 0) || !std::isfinite(radius) || type < 0) return "no radius or type: " + line;
  }
  return "";
}

}  // namespace

TEST_CASE("what is written, read and written again is the same", "[skeleton_io]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton all = random_skeleton(seed, seed % 2 == 1);
    INFO("seed " << seed);
    REQUIRE(test::fault_of(all) == "");
    for (const auto format : exact_formats) {
      INFO("format " << static_cast<int>(format));
      const bool with_sections =
          std::find(formats_with_sections.begin(), formats_with_sections.end(), format) !=
          formats_with_sections.end();
      const std::string text = format_skeleton(all, format);
      const CurveSkeleton back = read(text, format);
      REQUIRE(back == (with_sections ? all : without_sections(all)));
      REQUIRE(format_skeleton(back, format) == text);
    }
  }
}

TEST_CASE("an SWC holds all edges, in another order", "[skeleton_io]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed);
    INFO("seed " << seed);
    const std::string text = format_skeleton(s, SkeletonFormat::Swc);
    REQUIRE(swc_fault(text) == "");
    const CurveSkeleton back = read(text, SkeletonFormat::Swc);
    REQUIRE(test::fault_of(back) == "");
    REQUIRE(balls_of(back) == balls_of(s));
    REQUIRE(lines_of(back) == lines_of(s));
    REQUIRE(format_skeleton(back, SkeletonFormat::Swc) == text);
  }
}

TEST_CASE("polylines hold all edges", "[skeleton_io]") {
  for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
    const CurveSkeleton s = random_skeleton(seed);
    INFO("seed " << seed);
    const CurveSkeleton back =
        read(format_skeleton(s, SkeletonFormat::Polylines), SkeletonFormat::Polylines, 7);
    REQUIRE(test::fault_of(back) == "");
    REQUIRE(back.nodes.size() == s.nodes.size());
    REQUIRE(lines_of(back) == lines_of(s));
    for (const auto& node : back.nodes) REQUIRE(node.radius == 7);
  }
}

TEST_CASE("the texts of the other formats are these", "[skeleton_io]") {
  // A triangle with a tail from its thickest node, and a node alone.
  const CurveSkeleton s{
      {{{0, 0, 0}, 1}, {{1, 0, 0}, 2}, {{0, 1, 0}, 1}, {{2, 0, 0}, 1}, {{9, 9, 9}, 0.5}},
      {{0, 1}, {0, 2}, {1, 2}, {1, 3}}};
  CHECK(format_skeleton(s, SkeletonFormat::Swc) ==
        "# marrow curve-skeleton\n# id type x y z radius parent\n"
        "1 0 1 0 0 2 -1\n2 0 0 0 0 1 1\n3 0 0 1 0 1 2\n4 0 2 0 0 1 1\n5 0 9 9 9 0.5 -1\n"
        "# loop-edge 1 3\n");
  CHECK(format_skeleton(s, SkeletonFormat::Cg) ==
        "# D:3 NV:5 NE:4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 9 9 9\n"
        "e 1 2\ne 1 3\ne 2 3\ne 2 4\n"
        "# radius 1 1\n# radius 2 2\n# radius 3 1\n# radius 4 1\n# radius 5 0.5\n");
  CHECK(format_skeleton(s, SkeletonFormat::Polylines) ==
        "4 1 0 0 0 0 0 0 1 0 1 0 0\n2 1 0 0 2 0 0\n1 9 9 9\n");
  CHECK(format_skeleton(s, SkeletonFormat::Graph) ==
        "n 0 0 0 1\nn 1 0 0 2\nn 0 1 0 1\nn 2 0 0 1\nn 9 9 9 0.5\n"
        "c 0 1\nc 0 2\nc 1 2\nc 1 3\n");
  CHECK(format_skeleton(s, SkeletonFormat::Csv) ==
        "id,x,y,z,radius,component,neighbours\n0,0,0,0,1,0,1 2\n1,1,0,0,2,0,0 2 3\n"
        "2,0,1,0,1,0,0 1\n3,2,0,0,1,0,1\n4,9,9,9,0.5,1,\n");
  CHECK(format_skeleton({{{{0, 0, 0}, 1, 1.5}, {{3, 4, 0}, 2}}, {{0, 1}}}, SkeletonFormat::Dot) ==
        "graph skeleton {\n  node [shape=point];\n"
        "  0 [x=\"0\", y=\"0\", z=\"0\", radius=\"1\", section_radius=\"1.5\"];\n"
        "  1 [x=\"3\", y=\"4\", z=\"0\", radius=\"2\", section_radius=\"0\"];\n"
        "  0 -- 1 [length=\"5\"];\n}\n");
}

TEST_CASE("section radii make a JSON of version 2", "[skeleton_io]") {
  CurveSkeleton s{{{{0, 0, 0}, 1}, {{1, 0, 0}, 2}}, {{0, 1}}};
  CHECK(format_skeleton(s, SkeletonFormat::Json).find("\"version\": 1,") != std::string::npos);
  s.nodes[1].section_radius = 3;
  const std::string text = format_skeleton(s, SkeletonFormat::Json);
  CHECK(text.find("\"version\": 2,") != std::string::npos);
  CHECK(text.find("[0, 0, 0, 1, 0],\n    [1, 0, 0, 2, 3]\n") != std::string::npos);
  s.nodes[1].section_radius = 1;
  for (const auto format : exact_formats) CHECK_THROWS_AS(format_skeleton(s, format), Error);
}

TEST_CASE("the files of other programs are read", "[skeleton_io]") {
  const CurveSkeleton path{{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}}, {{0, 1}, {1, 2}}};
  const std::string cg = "# D:3 NV:3 NE:2\nv 0 0 0\nv 1 0 0\nv 2 0 0\n";
  CHECK(read(cg + "e 1 2\ne 2 3\n", SkeletonFormat::Cg, 1) == path);
  CHECK(read(cg + "e 0 1\ne 1 2\n", SkeletonFormat::Cg, 1) == path);  // CGoGN_3
  CHECK(read("# D:3 NV:3 NE:2\nv 0 0 0 1\nv 1 0 0 1\nv 2 0 0 1\ne 0 1\ne 1 2\n",
             SkeletonFormat::Cg) == path);
  CHECK(read("n 0 0 0\nn 1 0 0\nn 2 0 0\nc 0 1\nc 2 1\n", SkeletonFormat::Graph, 1) == path);
  CHECK(read("v 0 0 0\nv 1 0 0\nv 2 0 0\nl 1 2 3\n", SkeletonFormat::Obj, 1) == path);
  // Types, more columns, gaps in the ids, a child before its parent.
  CHECK(read("# neuron\n7 3 0 0 0 1 9 extra\n9 1 1 0 0 1 -1\r\n30 3 2 0 0 1.0 9\n",
             SkeletonFormat::Swc) == path);
  CHECK(read("2 0 0 0 1 0 0\n\n3 1 0 0 1 0 0 2 0 0\n", SkeletonFormat::Polylines, 1) == path);
  CHECK(read("z,\"x\",y, id ,note,neighbours,radius\n0,0,0,5,a,6,1\n0,1,0,6,b,5 "
             "7,\"1\"\n0,2,0,7,,,1\n",
             SkeletonFormat::Csv) == path);
}

TEST_CASE("a file without radii is refused where none is given for it", "[skeleton_io]") {
  const std::string words = "a node without a radius";
  for (const auto& [text, format] : std::map<std::string, SkeletonFormat>{
           {"# D:3 NV:1 NE:0\nv 0 0 0\n", SkeletonFormat::Cg},
           {"n 0 0 0\n", SkeletonFormat::Graph},
           {"v 0 0 0\n", SkeletonFormat::Obj},
           {"1 0 0 0\n", SkeletonFormat::Polylines},
           {"id,x,y,z,neighbours\n0,0,0,0,\n", SkeletonFormat::Csv}}) {
    CHECK(error_of(text, format).find(words) != std::string::npos);
    CHECK(read(text, format, 2).nodes.at(0).radius == 2);
  }
}

TEST_CASE("a malformed CG is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) {
    return error_of(text, SkeletonFormat::Cg, ErrorKind::Malformed, 1);
  };
  const std::string two = "# D:3 NV:2 NE:1\nv 0 0 0\nv 1 0 0\n";
  CHECK(error(two + "e 1 2\n") == "");
  CHECK(error("") == "f:0: the file ends before the line '# D:3 NV:nodes NE:edges'");
  CHECK(error("# D:2 NV:0 NE:0\n") == "f:1: the first line is not '# D:3 NV:nodes NE:edges'");
  CHECK(error("# D:3 NV:x NE:0\n") != "");
  CHECK(error("v 0 0 0\n") != "");
  CHECK(error(two + "e 1 3\n") == "f:4: vertex index 3 is out of range 1..2");
  CHECK(error("# D:3 NV:2 NE:2\nv 0 0 0\nv 1 0 0\ne 0 1\ne 1 2\n") ==
        "f:5: vertex index 2 is out of range 0..1; another line has the index 0");
  CHECK(error(two + "e 1 1\n") == "f:4: an edge from a node to itself");
  CHECK(error(two) == "f:3: the first line claims 2 nodes and 1 edges, the file has 2 and 0");
  CHECK(error(two + "e 1 2 3\n") != "");
  CHECK(error(two + "e 1 -2\n") != "");
  CHECK(error(two + "e 1 2\n# radius 3 1\n") == "f:5: vertex index 3 is out of range 1..2");
  CHECK(error(two + "e 1 2\n# radius 1 0\n") == "f:5: the radius '0' is not greater than 0");
  CHECK(error(two + "e 1 2\n# radius 1\n") != "");
  CHECK(error(two + "e 1 2\nf 1 2 2\n") != "");
  CHECK(error("# D:3 NV:18446744073709551615 NE:0\nv 0 0 0\n") != "");
}

TEST_CASE("a malformed GRAPH is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Graph); };
  CHECK(error("n 0 0 0 1\nn 1 0 0 1\nc 0 1\n") == "");
  CHECK(error("n 0 0\n") == "f:1: a node is 'n x y z radius'; this line has 2 numbers");
  CHECK(error("n 0 0 0 0\n") == "f:1: the radius '0' is not greater than 0");
  CHECK(error("n 0 0 0 1\nc 0 1\n") ==
        "f:2: node index 1 is not below 1, the number of nodes so far");
  CHECK(error("n 0 0 0 1\nc 0 0\n") == "f:2: an edge from a node to itself");
  CHECK(error("n 0 0 0 1\nc 0\n") == "f:2: a connection is 'c i j'");
  CHECK(error("c 0 1\n") != "");
  CHECK(error("x 0 1\n") != "");
  CHECK(error("n nan 0 0 1\n") == "f:1: 'nan' is not a finite number");
}

TEST_CASE("a malformed SWC is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Swc); };
  const std::string root = "1 0 0 0 0 1 -1\n";
  CHECK(error(root + "2 0 1 0 0 1 1\n") == "");
  CHECK(error("1 0 0 0 0 1\n") ==
        "f:1: a node is 'id type x y z radius parent'; this line has 6 words");
  CHECK(error(root + "2 0 1 0 0 0 1\n") == "f:2: the radius '0' is not greater than 0");
  CHECK(error(root + "2 0 1 0 0 1 3\n") == "f:2: parent 3 is no id of this file");
  CHECK(error(root + "2 0 1 0 0 1 2\n") == "f:2: an edge from a node to itself");
  CHECK(error(root + root) == "f:2: the id 1 is given twice");
  CHECK(error("1 0 0 0 0 1 2\n2 0 1 0 0 1 1\n") ==
        "f:2: the parents of node 2 lead back to it; an edge that closes a cycle is "
        "'# loop-edge i j'");
  CHECK(error(root + "# loop-edge 1 2\n") == "f:2: node 2 is no id of this file");
  CHECK(error(root + "# loop-edge 1\n") == "f:2: an edge that closes a cycle is '# loop-edge i j'");
  CHECK(error("1 x 0 0 0 1 -1\n") == "f:1: 'x' is not an integer");
}

TEST_CASE("malformed polylines are refused with their line", "[skeleton_io]") {
  const auto error = [](const std::string& text) {
    return error_of(text, SkeletonFormat::Polylines, ErrorKind::Malformed, 1);
  };
  CHECK(error("2 0 0 0 1 1 1\n") == "");
  CHECK(error("2 0 0 0 1 1\n") == "f:1: the line claims 2 points and has 5 numbers");
  CHECK(error("3 0 0 0 1 1 1\n") == "f:1: the line claims 3 points and has 6 numbers");
  CHECK(error("0\n") != "");
  CHECK(error("18446744073709551615 0 0 0\n") != "");
  CHECK(error("1 0 0 inf\n") == "f:1: 'inf' is not a finite number");
  CHECK(error("1.5 0 0 0\n") == "f:1: '1.5' is not a count");
}

TEST_CASE("a malformed CSV is refused with its line", "[skeleton_io]") {
  const auto error = [](const std::string& text) { return error_of(text, SkeletonFormat::Csv); };
  const std::string header = "id,x,y,z,radius,section_radius,neighbours\n";
  CHECK(error(header + "0,0,0,0,1,0,1\n1,1,0,0,1,1,0\n") == "");
  CHECK(error("") != "");
  CHECK(error("x,y,z\n") == "f:1: no column 'id'; a curve-skeleton has id,x,y,z,radius,neighbours");
  CHECK(error(header + "0,0,0,0,1,0\n") == "f:2: a row has 6 fields, the first line has 7");
  CHECK(error(header + "0,0,0,,1,0,\n") == "f:2: '' is not a finite number");
  CHECK(error(header + "0,0,0,0,1,0.5,\n") ==
        "f:2: the section radius '0.5' is neither 0 nor at least the radius");
  CHECK(error(header + "0,0,0,0,1,0,7\n") == "f:2: neighbour 7 is no id of this file");
  CHECK(error(header + "0,0,0,0,1,0,x\n") == "f:2: 'x' is not an id");
  CHECK(error(header + "0,0,0,0,1,0,0\n") == "f:2: an edge from a node to itself");
  CHECK(error(header + "0,0,0,0,1,0,\n0,0,0,0,1,0,\n") == "f:3: the id 0 is given twice");
}

TEST_CASE("every format has a name", "[skeleton_io]") {
  for (const std::string& name : skeleton_formats())
    CHECK(skeleton_formats().at(static_cast<std::size_t>(skeleton_format_of("x." + name))) == name);
  CHECK(skeleton_format_of("a.polylines.txt") == SkeletonFormat::Polylines);
  CHECK(skeleton_format_of("a.gv") == SkeletonFormat::Dot);
  CHECK_THROWS_AS(skeleton_format_of("a.txt"), Error);
  CHECK(readable_skeleton_formats().size() == skeleton_formats().size() - 2);
  CHECK_THROWS_AS(read("graph {}", SkeletonFormat::Dot), Error);
}
