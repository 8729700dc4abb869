#include "scene_shape.hpp"

#include <marrow/error.hpp>

#include <assimp/scene.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace marrow {

namespace {

/// x -> axes * x + origin.
struct Placement {
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 origin;

  Vec3 direction(const Vec3& d) const { return axes[0] * d.x + axes[1] * d.y + axes[2] * d.z; }
  Vec3 point(const Vec3& p) const { return direction(p) + origin; }
  bool is_mirrored() const { return dot(cross(axes[0], axes[1]), axes[2]) < 0; }
};

/// First `inner`, then `outer`.
Placement combined(const Placement& outer, const aiMatrix4x4& inner) {
  const auto column = [](double a, double b, double c) { return Vec3{a, b, c}; };
  const aiMatrix4x4& m = inner;
  return {{outer.direction(column(m.a1, m.b1, m.c1)), outer.direction(column(m.a2, m.b2, m.c2)),
           outer.direction(column(m.a3, m.b3, m.c3))},
          outer.point(column(m.a4, m.b4, m.c4))};
}

class Gatherer {
 public:
  explicit Gatherer(std::uint64_t max_triangles) : max_triangles_(max_triangles) {}

  void add(const aiMesh& mesh, const Placement& placement) {
    if (shape_.points.size() + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::Limit, "holds more points than can be counted; simplify the shape");
    const auto first = static_cast<std::uint32_t>(shape_.points.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      shape_.points.push_back(placement.point({v.x, v.y, v.z}));
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
      add_face(mesh.mFaces[i], mesh.mNumVertices, first, placement.is_mirrored());
  }

  Shape take() { return std::move(shape_); }

 private:
  void add_face(const aiFace& face, unsigned points, std::uint32_t first, bool is_mirrored) {
    if (face.mNumIndices != 3) return;
    if (shape_.triangles.size() == max_triangles_)
      throw Error(ErrorKind::Limit, "holds more triangles than the limit of " +
                                        std::to_string(max_triangles_) +
                                        "; raise the limit or simplify the shape");
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned corner = face.mIndices[is_mirrored ? 2 - k : k];
      if (corner >= points)
        throw Error(ErrorKind::Malformed, "a face uses vertex " + std::to_string(corner) +
                                              " of a mesh of " + std::to_string(points) +
                                              "; export the shape again");
      t[k] = first + corner;
    }
    shape_.triangles.push_back(t);
  }

  std::uint64_t max_triangles_;
  Shape shape_;
};

struct PlacedNode {
  const aiNode* node;
  Placement placement;
};

}  // namespace

Shape shape_of_scene(const aiScene& scene, std::uint64_t max_triangles) {
  Gatherer gatherer(max_triangles);
  std::vector<PlacedNode> waiting;
  if (scene.mRootNode) waiting.push_back({scene.mRootNode, {}});
  while (!waiting.empty()) {
    const aiNode& node = *waiting.back().node;
    const Placement placement = combined(waiting.back().placement, node.mTransformation);
    waiting.pop_back();
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (node.mMeshes[i] < scene.mNumMeshes)
        gatherer.add(*scene.mMeshes[node.mMeshes[i]], placement);
    for (unsigned i = node.mNumChildren; i-- > 0;)
      waiting.push_back({node.mChildren[i], placement});
  }
  Shape shape = gatherer.take();
  if (shape.points.empty())
    throw Error(ErrorKind::Empty, "holds no mesh; there is nothing to read");
  return shape;
}

}  // namespace marrow
