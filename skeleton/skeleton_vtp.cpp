// VTK's PolyData in XML, for ParaView and VMTK: a polyline for every branch, a vertex for every
// node without an edge. The array of radii has the name that VMTK gives it.
#include <marrow/error.hpp>

#include <optional>

#include "skeleton_xml_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr std::string_view kRadius = "MaximumInscribedSphereRadius", kSection = "SectionRadius";

/// `<DataArray ...>`, numbers in lines, `</DataArray>`.
template <class AppendRows>
void append_array(std::string& text, const std::string& attributes, AppendRows append_rows) {
  text += "        <DataArray " + attributes + " format=\"ascii\">\n";
  append_rows();
  text += "        </DataArray>\n";
}

template <class Values>
void append_values(std::string& text, const std::string& attributes, const Values& values) {
  append_array(text, attributes, [&] {
    for (const auto value : values) {
      append(text, value);
      text += '\n';
    }
  });
}

void append_point_data(std::string& text, const CurveSkeleton& skeleton) {
  std::vector<double> radii, sections;
  for (const auto& node : skeleton.nodes) {
    radii.push_back(node.radius);
    sections.push_back(node.section_radius);
  }
  text += "      <PointData Scalars=\"" + std::string(kRadius) + "\">\n";
  append_values(text, "type=\"Float64\" Name=\"" + std::string(kRadius) + "\"", radii);
  if (has_section_radii(skeleton))
    append_values(text, "type=\"Float64\" Name=\"" + std::string(kSection) + "\"", sections);
  text += "      </PointData>\n";
}

void append_points(std::string& text, const CurveSkeleton& skeleton) {
  text += "      <Points>\n";
  append_array(text, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", [&] {
    for (const auto& node : skeleton.nodes) {
      append(text, node.position.x);
      text += ' ';
      append(text, node.position.y);
      text += ' ';
      append(text, node.position.z);
      text += '\n';
    }
  });
  text += "      </Points>\n";
}

/// Cells of one kind: their points one cell a line, and where each cell ends among them.
void append_cells(std::string& text, const char* kind,
                  const std::vector<std::vector<NodeId>>& cells) {
  text += std::string("      <") + kind + ">\n";
  append_array(text, "type=\"Int32\" Name=\"connectivity\"", [&] {
    for (const auto& cell : cells)
      for (std::size_t i = 0; i < cell.size(); ++i) {
        append(text, std::uint64_t{cell[i]});
        text += i + 1 < cell.size() ? ' ' : '\n';
      }
  });
  append_array(text, "type=\"Int32\" Name=\"offsets\"", [&] {
    std::uint64_t end = 0;
    for (const auto& cell : cells) {
      append(text, end += cell.size());
      text += '\n';
    }
  });
  text += std::string("      </") + kind + ">\n";
}

/// Cells of points come before lines; they are of no branch.
void append_cell_data(std::string& text, const CurveSkeleton& skeleton,
                      const std::vector<std::vector<NodeId>>& points,
                      const std::vector<std::vector<NodeId>>& lines) {
  const auto component = component_of_nodes(skeleton);
  text += "      <CellData Scalars=\"BranchId\">\n";
  append_array(text, "type=\"Int32\" Name=\"BranchId\"", [&] {
    for (std::size_t i = 0; i < points.size(); ++i) text += "-1\n";
    for (std::size_t i = 0; i < lines.size(); ++i) {
      append(text, std::uint64_t{i});
      text += '\n';
    }
  });
  std::vector<std::uint64_t> ids;
  for (const auto* cells : {&points, &lines})
    for (const auto& cell : *cells) ids.push_back(component[cell[0]]);
  append_values(text, "type=\"Int32\" Name=\"ComponentId\"", ids);
  text += "      </CellData>\n";
}

void append_piece(std::string& text, const CurveSkeleton& skeleton) {
  std::vector<std::vector<NodeId>> points, lines;
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) points.push_back({n});
  for (Branch& branch : branches(skeleton)) lines.push_back(std::move(branch.nodes));
  text += "    <Piece NumberOfPoints=\"" + std::to_string(skeleton.nodes.size()) +
          "\" NumberOfVerts=\"" + std::to_string(points.size()) + "\" NumberOfLines=\"" +
          std::to_string(lines.size()) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  append_point_data(text, skeleton);
  append_cell_data(text, skeleton, points, lines);
  append_points(text, skeleton);
  append_cells(text, "Verts", points);
  append_cells(text, "Lines", lines);
  text += "    </Piece>\n";
}

/// What the arrays of a piece hold, if they are there.
struct Piece {
  std::optional<std::vector<double>> points, radii, other_radii, sections;
  std::vector<std::uint64_t> connectivity, offsets;
};

/// The name of the array that has just started, or "".
std::string name_of_array(const XmlReader& xml) {
  if (const std::string* format = xml.attribute("format"); format != nullptr && *format != "ascii")
    throw Error(ErrorKind::Unsupported, xml.source().name + ":" + std::to_string(xml.line()) +
                                            ": data in " + quoted(*format) +
                                            "; write it as ascii (in ParaView: Data Mode Ascii)");
  const std::string* name = xml.attribute("Name");
  return name == nullptr ? "" : *name;
}

void read_point_data(XmlReader& xml, Piece& piece) {
  const std::string name = name_of_array(xml);
  if (name == kRadius)
    piece.radii = xml.element_numbers<double>();
  else if (name == "Radius" || name == "radius")
    piece.other_radii = xml.element_numbers<double>();
  else if (name == kSection)
    piece.sections = xml.element_numbers<double>();
  else
    xml.skip_element();
}

void read_points(XmlReader& xml, Piece& piece) {
  name_of_array(xml);
  if (xml.required("NumberOfComponents") != "3") xml.fail("points need 3 components");
  piece.points = xml.element_numbers<double>();
}

void read_lines(XmlReader& xml, Piece& piece) {
  const std::string name = name_of_array(xml);
  if (name == "connectivity")
    piece.connectivity = xml.element_numbers<std::uint64_t>();
  else if (name == "offsets")
    piece.offsets = xml.element_numbers<std::uint64_t>();
  else
    xml.skip_element();
}

/// The arrays of the group that has just started.
void read_group(XmlReader& xml, Piece& piece) {
  const std::string_view group = xml.name();
  const auto read = group == "PointData" ? read_point_data
                    : group == "Points"  ? read_points
                    : group == "Lines"   ? read_lines
                                         : nullptr;
  if (read == nullptr) return xml.skip_element();
  xml.for_each_child([&] {
    if (xml.name() == "DataArray")
      read(xml, piece);
    else
      xml.skip_element();
  });
}

void check_count(const XmlReader& xml, const std::string& claim, const char* what,
                 std::size_t count) {
  if (!claim.empty() && claim != std::to_string(count))
    xml.fail("the piece claims " + quoted(claim) + " " + what + " and has " +
             std::to_string(count));
}

/// Of the piece that has just started.
std::string claim_of(const XmlReader& xml, const char* attribute) {
  const std::string* claim = xml.attribute(attribute);
  return claim == nullptr ? "" : *claim;
}

std::vector<CurveSkeleton::Node> nodes_of(const XmlReader& xml, const Piece& piece) {
  const std::vector<double> none;
  const auto& points = piece.points ? *piece.points : none;
  const auto& radii = piece.radii ? piece.radii : piece.other_radii;
  if (points.size() % 3 != 0) xml.fail("a point has fewer than 3 numbers");
  const std::size_t count = points.size() / 3;
  if (radii) check_count(xml, std::to_string(count), "points, but of radii it", radii->size());
  if (piece.sections)
    check_count(xml, std::to_string(count), "points, but of section radii it",
                piece.sections->size());
  std::vector<CurveSkeleton::Node> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    CurveSkeleton::Node node{{points[3 * i], points[3 * i + 1], points[3 * i + 2]}};
    if (radii) node.radius = (*radii)[i];
    if (piece.sections) node.section_radius = (*piece.sections)[i];
    std::string fault = check_radius(node.radius, radii.has_value(), xml.source());
    if (fault.empty()) fault = check_section_radius(node.section_radius, node.radius);
    if (!fault.empty()) xml.fail("point " + std::to_string(i) + ": " + fault);
    nodes.push_back(node);
  }
  return nodes;
}

std::vector<CurveSkeleton::Edge> edges_of(const XmlReader& xml, const Piece& piece,
                                          std::size_t nodes) {
  std::vector<CurveSkeleton::Edge> edges;
  std::uint64_t begin = 0;
  for (const std::uint64_t end : piece.offsets) {
    if (end > piece.connectivity.size() || end < begin + 2)
      xml.fail("a line ends at " + std::to_string(end) + ", begins at " + std::to_string(begin) +
               ": it needs two points or more of " + std::to_string(piece.connectivity.size()));
    for (std::uint64_t i = begin; i < end; ++i) {
      const std::uint64_t n = piece.connectivity[i];
      if (n >= nodes)
        xml.fail("point index " + std::to_string(n) + " is not below " + std::to_string(nodes));
      if (i == begin) continue;
      const std::uint64_t last = piece.connectivity[i - 1];
      if (n == last) xml.fail("an edge from node " + std::to_string(n) + " to itself");
      edges.push_back({static_cast<NodeId>(last), static_cast<NodeId>(n)});
    }
    begin = end;
  }
  if (begin != piece.connectivity.size())
    xml.fail("the lines end at " + std::to_string(begin) + " of " +
             std::to_string(piece.connectivity.size()) + " points");
  return edges;
}

CurveSkeleton read_piece(XmlReader& xml) {
  const std::string points = claim_of(xml, "NumberOfPoints"),
                    lines = claim_of(xml, "NumberOfLines"),
                    polygons = claim_of(xml, "NumberOfPolys"),
                    strips = claim_of(xml, "NumberOfStrips");
  check_count(xml, polygons, "polygons, which no curve-skeleton has,", 0);
  check_count(xml, strips, "strips, which no curve-skeleton has,", 0);
  Piece piece;
  xml.for_each_child([&] { read_group(xml, piece); });
  CurveSkeleton skeleton{nodes_of(xml, piece), {}};
  check_count(xml, points, "points", skeleton.nodes.size());
  check_count(xml, lines, "lines", piece.offsets.size());
  skeleton.edges = edges_of(xml, piece, skeleton.nodes.size());
  return skeleton;
}

}  // namespace

std::string format_vtp(const CurveSkeleton& skeleton) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <PolyData>\n";
  append_piece(text, skeleton);
  return text + "  </PolyData>\n</VTKFile>\n";
}

CurveSkeleton parse_vtp(std::string_view bytes, const Source& source) {
  XmlReader xml(bytes, source);
  if (xml.next() != XmlReader::Event::Start || xml.name() != "VTKFile" ||
      xml.required("type") != "PolyData")
    xml.fail("the first element is not <VTKFile type=\"PolyData\">");
  std::optional<CurveSkeleton> skeleton;
  xml.for_each_child([&] {
    if (xml.name() != "PolyData") return xml.skip_element();
    xml.for_each_child([&] {
      if (xml.name() != "Piece") return xml.skip_element();
      if (skeleton) xml.fail("a second piece; write the file in one");
      skeleton = read_piece(xml);
    });
  });
  xml.next();  // nothing follows
  if (!skeleton) xml.fail("no piece in the file");
  tidy_edges(*skeleton);
  return *std::move(skeleton);
}

}  // namespace marrow::skeleton_detail
