// Lines and meshes as binary glTF 2.0, for Blender and browsers.
#include <marrow/capsule_mesh.hpp>

#include "glb_builder_detail.hpp"
#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

/// The nodes without an edge.
std::vector<std::uint32_t> lone_nodes(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton);
  std::vector<std::uint32_t> lone;
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) lone.push_back(n);
  return lone;
}

}  // namespace

std::string format_glb(const CurveSkeleton& skeleton) {
  GlbBuilder glb;
  if (skeleton.nodes.empty()) return glb.finish();
  std::vector<Vec3> points;
  std::vector<double> radii, sections;
  for (const auto& node : skeleton.nodes) {
    points.push_back(node.position);
    radii.push_back(node.radius);
    sections.push_back(node.section_radius);
  }
  std::string attributes = R"({"POSITION":)" + std::to_string(glb.add_positions(points)) +
                           R"(,"_RADIUS":)" + std::to_string(glb.add_scalars(radii));
  if (has_section_radii(skeleton))
    attributes += R"(,"_SECTION_RADIUS":)" + std::to_string(glb.add_scalars(sections));
  attributes += '}';
  std::vector<std::uint32_t> ends;
  for (const auto& e : skeleton.edges) ends.insert(ends.end(), e.begin(), e.end());
  if (!ends.empty()) glb.add_primitive(attributes, glb.add_indices(ends), GlbBuilder::Lines);
  const auto lone = lone_nodes(skeleton);
  if (!lone.empty()) glb.add_primitive(attributes, glb.add_indices(lone), GlbBuilder::Points);
  return glb.finish();
}

}  // namespace marrow::skeleton_detail

namespace marrow {

std::string format_glb(const Shape& mesh) {
  using namespace skeleton_detail;
  GlbBuilder glb;
  if (mesh.triangles.empty()) return glb.finish();
  const std::size_t positions = glb.add_positions(mesh.points);
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  glb.add_primitive(R"({"POSITION":)" + std::to_string(positions) + "}", glb.add_indices(corners),
                    GlbBuilder::Triangles);
  return glb.finish();
}

}  // namespace marrow
