// How centred lines are in the sections of a surface.
#pragma once

#include <marrow/quality.hpp>
#include <marrow/surface_scene.hpp>

namespace marrow {

/// Of some `samples` places along the lines of `skeleton`, which lies in the frame of `surface`.
/// Each takes 32 pairs of opposite distances in the plane across the line, whose direction is the
/// chord over half a ball on either side. Left out: places outside, or nearer to the end of their
/// branch than to the surface (there is no tube there), and pairs with a ray that leaves through a
/// hole. `diagonal` is that of the shape's box. Nothing where no place is left.
std::optional<Centredness> centredness(const SurfaceScene& surface, const CurveSkeleton& skeleton,
                                       double diagonal, int samples);

}  // namespace marrow
