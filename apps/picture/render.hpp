// A shape and its skeleton in one picture (marrow render).
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <string>

#include "picture/camera.hpp"
#include "picture/image.hpp"

namespace marrow {

struct RenderOptions {
  int width = 1600;   ///< pixels, 64 to 16384
  int height = 1200;  ///< pixels, 64 to 16384
  ViewChoice view = ViewChoice::All;
  Colour background{1, 1, 1};
  bool legend = true;  ///< also names of views and lines between them
};

/// The chosen view, or front, side, top and three-quarter view: the shape as an X-ray, on it the
/// skeleton as tubes coloured by radius, joints as white and leaves as green balls, and a legend
/// with the range of radii in input units and the counts. Shapes without triangles show their
/// points as small discs. Any legal input works: flat, a single node, no skeleton, no shape. The
/// same input gives the same pixels for any number of threads on one machine. Throws Error: Usage
/// (size out of range), Internal.
RgbImage render_picture(const Shape& shape, const CurveSkeleton& skeleton,
                        const RenderOptions& options = {});

/// The same as lines in SVG, without the surface: in its place the balls and cones that the
/// skeleton stands for, in one pale colour. Throws Error: Usage (size out of range).
std::string render_svg(const Shape& shape, const CurveSkeleton& skeleton,
                       const RenderOptions& options = {});

}  // namespace marrow
