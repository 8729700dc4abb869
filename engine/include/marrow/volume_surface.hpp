// The boundary of a volume: the faces where foreground meets background.
#pragma once

#include <marrow/shape.hpp>
#include <marrow/volume.hpp>

#include <cstddef>

namespace marrow {

/// Faces between a foreground and a background voxel; at the border of the box there is background.
std::size_t boundary_face_count(const Volume& volume);

/// These faces as two triangles each, in world units, outside to the right-hand side: closed and
/// oriented. Voxels that touch in an edge or a corner share its points, and four faces may meet in
/// such an edge. Throws Error: Limit (more than 100,000,000 triangles).
Shape boundary_surface(const Volume& volume);

}  // namespace marrow
