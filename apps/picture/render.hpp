// A shape and its skeleton in one picture (marrow render).
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include "picture/image.hpp"

namespace marrow {

struct RenderOptions {
  int width = 1600;   ///< pixels, 64 to 16384
  int height = 1200;  ///< pixels, 64 to 16384
};

/// Front, side, top and three-quarter view: the shape as an X-ray, on it the skeleton as tubes
/// coloured by radius, joints as white and leaves as green balls, and a legend with the range of
/// radii in input units and the counts. Shapes without triangles show their points as small discs.
/// Any legal input works: flat, a single node, no skeleton, no shape. The same input gives the same
/// pixels for any number of threads on one machine.
/// Throws Error: Usage (size out of range), Internal.
RgbImage render_picture(const Shape& shape, const CurveSkeleton& skeleton,
                        const RenderOptions& options = {});

}  // namespace marrow
