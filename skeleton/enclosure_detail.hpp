// Whether a surface, open or closed, encloses a point.
#pragma once

#include <marrow/surface_scene.hpp>

namespace marrow {

/// Whether, for most of 42 directions, the signed crossings of the surface sum up to something (the
/// generalised winding number is over a half), or their number is odd: the same where triangles are
/// turned the wrong way round, or stand twice. Holes in the surface do not matter while most rays
/// miss them.
bool encloses(const SurfaceScene& surface, const Vec3& p);

}  // namespace marrow
