// VTP and GraphML: what others write, and what is refused.
#include <marrow/error.hpp>
#include <marrow/skeleton_io.hpp>

#include "catch.hpp"
#include "skeleton_text.hpp"

using namespace marrow;
using test::error_of;

namespace {

const CurveSkeleton path{{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}}, {{0, 1}, {1, 2}}};

/// `text` with the first `from` in it as `to`.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  REQUIRE(place != std::string::npos);
  return text.replace(place, from.size(), to);
}

}  // namespace

TEST_CASE("the text of a VTP is this", "[skeleton_io]") {
  const CurveSkeleton s{{{{0, 0, 0}, 1, 1.5}, {{1, 0, 0}, 2}, {{9, 9, 9}, 0.5}}, {{0, 1}}};
  CHECK(format_skeleton(s, SkeletonFormat::Vtp) == R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
  <PolyData>
    <Piece NumberOfPoints="3" NumberOfVerts="1" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="0">
      <PointData Scalars="MaximumInscribedSphereRadius">
        <DataArray type="Float64" Name="MaximumInscribedSphereRadius" format="ascii">
1
2
0.5
        </DataArray>
        <DataArray type="Float64" Name="SectionRadius" format="ascii">
1.5
0
0
        </DataArray>
      </PointData>
      <CellData Scalars="BranchId">
        <DataArray type="Int32" Name="BranchId" format="ascii">
-1
0
        </DataArray>
        <DataArray type="Int32" Name="ComponentId" format="ascii">
1
0
        </DataArray>
      </CellData>
      <Points>
        <DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0
1 0 0
9 9 9
        </DataArray>
      </Points>
      <Verts>
        <DataArray type="Int32" Name="connectivity" format="ascii">
2
        </DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">
1
        </DataArray>
      </Verts>
      <Lines>
        <DataArray type="Int32" Name="connectivity" format="ascii">
0 1
        </DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">
2
        </DataArray>
      </Lines>
    </Piece>
  </PolyData>
</VTKFile>
)");
}

TEST_CASE("the text of a GraphML is this", "[skeleton_io]") {
  const CurveSkeleton s{{{{0, 0, 0}, 1}, {{3, 4, 0}, 2}}, {{0, 1}}};
  CHECK(format_skeleton(s, SkeletonFormat::GraphMl) == R"(<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
  <key id="x" for="node" attr.name="x" attr.type="double"/>
  <key id="y" for="node" attr.name="y" attr.type="double"/>
  <key id="z" for="node" attr.name="z" attr.type="double"/>
  <key id="radius" for="node" attr.name="radius" attr.type="double"/>
  <key id="length" for="edge" attr.name="length" attr.type="double"/>
  <key id="branch" for="edge" attr.name="branch" attr.type="int"/>
  <graph id="skeleton" edgedefault="undirected">
    <node id="0"><data key="x">0</data><data key="y">0</data><data key="z">0</data><data key="radius">1</data></node>
    <node id="1"><data key="x">3</data><data key="y">4</data><data key="z">0</data><data key="radius">2</data></node>
    <edge source="0" target="1"><data key="length">5</data><data key="branch">0</data></edge>
  </graph>
</graphml>
)");
}

TEST_CASE("VTP files of others are read", "[skeleton_io]") {
  // Other arrays, another order, keys of VTK, a comment, quotes of the other kind.
  const std::string text = R"(<?xml version='1.0'?><!-- by hand -->
<VTKFile type='PolyData' version='1.0' header_type="UInt64"><PolyData><FieldData/>
<Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfLines="2"><Lines>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">2 4</DataArray></Lines><Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii" RangeMin="0">
0 0 0 1 0 0
2 0 0 <InformationKey name="L2_NORM_RANGE" length="1"><Value index="0">2</Value></InformationKey>
</DataArray></Points><PointData>
<DataArray type="Float64" Name="Radius" format="ascii">1 1 1</DataArray>
<DataArray type="Float64" Name="Speed" format="ascii">nan</DataArray>
</PointData></Piece></PolyData></VTKFile>)";
  CHECK(parse_skeleton(text, SkeletonFormat::Vtp, "f") == path);
  CHECK(error_of(with(text, "\"Radius\"", "\"Width\""), SkeletonFormat::Vtp)
            .find("a node without a radius") != std::string::npos);
  CHECK(error_of(with(text, "\"ascii\">0 1", "\"appended\">0 1"), SkeletonFormat::Vtp,
                 ErrorKind::Unsupported) ==
        "f:4: data in 'appended'; write it as ascii (in ParaView: Data Mode Ascii)");
}

TEST_CASE("a malformed VTP is refused with its line", "[skeleton_io]") {
  const std::string good = format_skeleton(path, SkeletonFormat::Vtp);
  const auto error = [&](const std::string& from, const std::string& to) {
    return error_of(with(good, from, to), SkeletonFormat::Vtp);
  };
  CHECK(error("0 1 2\n", "0 1 2\n") == "");
  CHECK(error("0 1 2\n", "0 1 3\n") == "f:41: point index 3 is not below 3");
  CHECK(error("0 1 2\n", "0 1 1\n") == "f:41: an edge from node 1 to itself");
  CHECK(error("0 1 2\n", "0 1 -2\n") == "f:35: '-2' is not an index");
  CHECK(error("0 1 2\n        </DataArray>\n        <DataArray type=\"Int32\" Name=\"offsets\" "
              "format=\"ascii\">\n3",
              "0 1 2\n        </DataArray>\n        <DataArray "
              "type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n1") ==
        "f:41: a line ends at 1, begins at 0: it needs two points or more of 3");
  CHECK(error("NumberOfPoints=\"3\"", "NumberOfPoints=\"4\"") ==
        "f:41: the piece claims '4' points and has 3");
  CHECK(error("NumberOfLines=\"1\"", "NumberOfLines=\"2\"") != "");
  CHECK(error("NumberOfPolys=\"0\"", "NumberOfPolys=\"1\"") != "");
  CHECK(error("2 0 0", "2 0 inf") == "f:24: 'inf' is not a finite number");
  CHECK(error("2 0 0", "2 0") == "f:41: a point has fewer than 3 numbers");
  CHECK(error("\"ascii\">\n1", "\"ascii\">\n-1") ==
        "f:41: point 0: the radius '-1' is not greater than 0");
  CHECK(error("\"ascii\">\n1\n1", "\"ascii\">\n1") != "");
  CHECK(error("VTKFile type=\"PolyData\"", "VTKFile type=\"ImageData\"") ==
        "f:2: the first element is not <VTKFile type=\"PolyData\">");
  CHECK(error("<Piece", "<Part") != "");
  CHECK(error("</VTKFile>", "</VTKFile><more/>") != "");
}

TEST_CASE("GraphML files of others are read", "[skeleton_io]") {
  // As networkx writes it, with a namespace, keys of numbers, data that is not read.
  CHECK(parse_skeleton(R"(<?xml version='1.0' encoding='utf-8'?>
<g:graphml xmlns:g="http://graphml.graphdrawing.org/xmlns"
  xsi:schemaLocation="http://graphml.graphdrawing.org/xmlns http://x/graphml.xsd">
  <g:key id="d5" for="edge" attr.name="x" attr.type="double" />
  <g:key id="d4" for="node" attr.name="color" attr.type="string"><default>red</default></g:key>
  <g:key id="d3" for="node" attr.name="radius" attr.type="long" />
  <g:key id="d2" for="node" attr.name="z" attr.type="double" />
  <g:key id="d1" for="all" attr.name="y" attr.type="double" />
  <g:key id="d0" for="node" attr.name="x" attr.type="double" />
  <g:graph edgedefault="directed"><g:edge source="b&amp;b" target="a" id="e">
      <g:data key="d5">7</g:data></g:edge>
    <g:node id="a"><g:data key="d0">0</g:data><g:data key="d1">0.0</g:data>
      <g:data key="d2">0</g:data><g:data key="d3">1</g:data></g:node>
    <g:node id="b&amp;b"><g:data key="d4">blue</g:data><g:data key="d0">1</g:data>
      <g:data key="d1">0</g:data><g:data key="d2">0</g:data><g:data key="d3">1</g:data></g:node>
    <g:node id="c"><g:data key="d0">2</g:data><g:data key="d1">0</g:data>
      <g:data key="d2">0</g:data><g:data key="d3">1</g:data></g:node>
    <g:edge source="b&amp;b" target="c"/>
  </g:graph>
</g:graphml>)",
                       SkeletonFormat::GraphMl, "f") == path);
}

TEST_CASE("a malformed GraphML is refused with its line", "[skeleton_io]") {
  const std::string good = format_skeleton(path, SkeletonFormat::GraphMl);
  const auto error = [&](const std::string& from, const std::string& to) {
    return error_of(with(good, from, to), SkeletonFormat::GraphMl);
  };
  CHECK(error("target=\"1\"", "target=\"1\"") == "");
  CHECK(error("target=\"1\"", "target=\"4\"") == "f:13: the node '4' is not in this file");
  CHECK(error("target=\"1\"", "target=\"0\"") == "f:13: an edge from a node to itself");
  CHECK(error("target=", "aim=") == "f:13: the element 'edge' has no attribute 'target'");
  CHECK(error("node id=\"1\"", "node id=\"0\"") == "f:11: the node '0' is given twice");
  CHECK(error("<data key=\"y\">0</data>", "") == "f:10: the node '0' has no y");
  CHECK(error("<data key=\"radius\">1</data>", "") != "");
  CHECK(error("\"radius\">1<", "\"radius\">0<") ==
        "f:10: the node '0': the radius '0' is not greater than 0");
  CHECK(error("\"radius\">1<", "\"radius\">1 2<") ==
        "f:10: the radius of a node is not one number");
  CHECK(error("\"x\">0<", "\"x\">nan<") == "f:10: 'nan' is not a finite number");
  CHECK(error("</graph>", "<hyperedge/></graph>") != "");
  CHECK(error("</graph>", "</graph><graph></graph>") != "");
  CHECK(error("<graphml ", "<gml ") != "");
  CHECK(error("</graphml>", "") == "f:17: the file ends before the end of 'graphml'");
  CHECK(error("</graph>", "</gruph>") == "f:15: the end of 'gruph' within 'graph'");
}

TEST_CASE("XML that could grow or lead elsewhere is refused", "[skeleton_io]") {
  const auto format = SkeletonFormat::GraphMl;
  CHECK(error_of("<!DOCTYPE x [<!ENTITY a \"b\">]><graphml/>", format, ErrorKind::Unsupported) !=
        "");
  CHECK(error_of("<graphml><graph><![CDATA[x]]></graph></graphml>", format,
                 ErrorKind::Unsupported) != "");
  CHECK(error_of("<graphml a='&x;'/>", format) == "f:1: '&x' is no entity that is read here");
  CHECK(error_of("<graphml a='&#65;'/>", format) != "");
  CHECK(error_of("<graphml a='&", format) != "");
  std::string deep = "<graphml>";
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  CHECK(error_of(deep, format, ErrorKind::Unsupported) ==
        "f:1: elements stand more than 64 deep in each other");
  for (const char* text :
       {"", " ", "x", "<", "<>", "<graphml", "<graphml a", "<graphml a=1/>", "<graphml a='<'/>",
        "<graphml/>", "<graphml/", "<graphml></graphml", "</graphml>", "<graphml></x>", "<!-- ",
        "<? ", "<graphml/>x", "<graphml><graph>"})
    CHECK(error_of(text, format) != "");
}

TEST_CASE("no prefix of an XML file is read as the whole", "[skeleton_io]") {
  for (const auto format : {SkeletonFormat::Vtp, SkeletonFormat::GraphMl}) {
    const std::string text = format_skeleton(path, format);
    for (std::size_t n = 0; n + 1 < text.size(); ++n) {
      INFO(text.substr(0, n));
      CHECK_THROWS_AS(parse_skeleton(text.substr(0, n), format, "f"), Error);
    }
  }
}
