// From Assimp's scene to one shape.
#pragma once

#include <marrow/shape.hpp>

#include <cstdint>

struct aiScene;

namespace marrow {

/// All meshes of the scene, each where its nodes put it, as often as they do. Points and lines are
/// left out. Throws Error: Malformed (an index out of range), Limit (more than `max_triangles`),
/// Empty.
Shape shape_of_scene(const aiScene& scene, std::uint64_t max_triangles);

}  // namespace marrow
