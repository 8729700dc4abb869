// The shape as an X-ray: every surface along a line of sight, with dark rims and soft light.
#pragma once

#include "picture/camera.hpp"
#include "picture/image.hpp"
#include "picture/surface_hits.hpp"

namespace marrow {

/// Paints the shape into the cell of `view`, over `paper`. The same pixels for any number of
/// threads.
void draw_xray(Canvas& canvas, const SurfaceTracer& shape, const View& view, const Colour& paper);

}  // namespace marrow
