#include <marrow/error.hpp>
#include <marrow/rig.hpp>

#include <algorithm>
#include <limits>

#include "glb_builder_detail.hpp"
#include "spanning_forest_detail.hpp"

namespace marrow {

namespace {

using namespace skeleton_detail;

/// glTF node 0 is the mesh, 1 the parent of all joints; joints follow in the order of the nodes.
constexpr std::size_t kFirstJoint = 2;

/// How far along the edge from a to b the place beside p is, from 0 to 1.
double share_along(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double squared = squared_length(along);
  return squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0;
}

/// The neighbours of every node along a branch, first those of lower places on it.
class Neighbours {
 public:
  explicit Neighbours(const std::vector<Branch>& branches) {
    for (const Branch& branch : branches) {
      std::vector<Entry> entries;
      for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
        entries.push_back({branch.nodes[i], branch.nodes[i - 1]});
        entries.push_back({branch.nodes[i - 1], branch.nodes[i]});
      }
      std::stable_sort(entries.begin(), entries.end(), is_before);
      of_branch_.push_back(std::move(entries));
    }
  }

  template <class Visit>
  void each(std::uint32_t branch, NodeId node, const Visit& visit) const {
    const auto& entries = of_branch_[branch];
    const auto [begin, end] =
        std::equal_range(entries.begin(), entries.end(), Entry{node, 0}, is_before);
    for (auto at = begin; at != end; ++at) visit(at->neighbour);
  }

 private:
  struct Entry {
    NodeId node, neighbour;
  };
  static bool is_before(const Entry& a, const Entry& b) { return a.node < b.node; }

  std::vector<std::vector<Entry>> of_branch_;
};

std::string list_of(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t n : numbers) {
    text += text.empty() ? '[' : ',';
    text += std::to_string(n);
  }
  return text + "]";
}

std::string joint(std::size_t n, const Vec3& offset, const std::vector<std::size_t>& children) {
  std::string text = R"(,{"name":"joint )" + std::to_string(n) + R"(","translation":[)";
  append_float(text, as_float(offset.x));
  text += ',';
  append_float(text, as_float(offset.y));
  text += ',';
  append_float(text, as_float(offset.z));
  text += ']';
  if (!children.empty()) text += R"(,"children":)" + list_of(children);
  return text + "}";
}

/// The joints as nodes of a scene, and the skin that names them.
GlbBuilder::Scene scene_of(const CurveSkeleton& skeleton, std::size_t matrices) {
  const SpanningForest forest = spanning_forest(skeleton);
  std::vector<std::vector<std::size_t>> children(skeleton.nodes.size());
  std::vector<std::size_t> roots, all;
  for (const NodeId n : forest.order) {
    const NodeId parent = forest.parent[n];
    (parent == kNoParent ? roots : children[parent]).push_back(n + kFirstJoint);
  }
  std::string joints = R"(,{"name":"joints","children":)" + list_of(roots) + "}";
  for (NodeId n = 0; n < skeleton.nodes.size(); ++n) {
    const NodeId parent = forest.parent[n];
    const Vec3 origin = parent == kNoParent ? Vec3{} : skeleton.nodes[parent].position;
    joints += joint(n, skeleton.nodes[n].position - origin, children[n]);
    all.push_back(n + kFirstJoint);
  }
  const std::string skin = R"(,"skins":[{"inverseBindMatrices":)" + std::to_string(matrices) +
                           R"(,"skeleton":1,"joints":)" + list_of(all) + "}]";
  return {R"(,"skin":0)", ",1", joints, skin, "shape"};
}

std::size_t add_bind_matrices(GlbBuilder& glb, const CurveSkeleton& skeleton) {
  std::vector<std::array<float, 16>> matrices;
  for (const auto& [p, radius, section] : skeleton.nodes)
    matrices.push_back({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,  // moved back to the origin
                        as_float(-p.x), as_float(-p.y), as_float(-p.z), 1});
  return glb.add_matrices(matrices);
}

/// `"JOINTS_0":..,"WEIGHTS_0":..`
std::string add_weights(GlbBuilder& glb, const std::vector<SkinWeight>& weights) {
  std::vector<std::array<std::uint16_t, 4>> joints;
  std::vector<std::array<float, 4>> shares;
  for (const SkinWeight& w : weights) {
    const auto share = static_cast<float>(w.second_share);
    // A joint without a share is to be 0.
    const NodeId second = share > 0 ? w.second : 0;
    joints.push_back({static_cast<std::uint16_t>(share < 1 ? w.first : 0),
                      static_cast<std::uint16_t>(second), 0, 0});
    shares.push_back({1 - share, share, 0, 0});
  }
  const std::size_t of_joints = glb.add_joints(joints);
  return R"("JOINTS_0":)" + std::to_string(of_joints) + R"(,"WEIGHTS_0":)" +
         std::to_string(glb.add_weights(shares));
}

}  // namespace

std::vector<SkinWeight> skin_weights(const Shape& mesh, const CurveSkeleton& skeleton,
                                     const SurfaceMap& map) {
  const Neighbours neighbours(map.branches);
  std::vector<SkinWeight> weights;
  weights.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const auto& place = map.places[i];
    SkinWeight weight{place.node, place.node, 0};
    neighbours.each(place.branch, place.node, [&](NodeId other) {
      const double share = share_along(mesh.points[i], skeleton.nodes[place.node].position,
                                       skeleton.nodes[other].position);
      if (share > weight.second_share) weight = {place.node, other, share};
    });
    weights.push_back(weight);
  }
  return weights;
}

std::string format_rig_glb(const Shape& mesh, const CurveSkeleton& skeleton,
                           const SurfaceMap& map) {
  if (mesh.triangles.empty())
    throw Error(ErrorKind::Empty, "a shape without triangles has no skin");
  if (skeleton.nodes.size() > std::numeric_limits<std::uint16_t>::max())
    throw Error(ErrorKind::Unsupported, std::to_string(skeleton.nodes.size()) +
                                            " joints are more than the 65,535 of a .glb; take "
                                            "nodes out by marrow convert --simplify");
  GlbBuilder glb;
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  const std::size_t positions = glb.add_positions(mesh.points);
  const std::string weights = add_weights(glb, skin_weights(mesh, skeleton, map));
  glb.add_primitive(R"({"POSITION":)" + std::to_string(positions) + "," + weights + "}",
                    glb.add_indices(corners), GlbBuilder::Triangles);
  return glb.finish(scene_of(skeleton, add_bind_matrices(glb, skeleton)));
}

}  // namespace marrow
