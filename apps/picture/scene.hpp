// What a picture shows, before it is painted or written: where everything is, and how large.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <vector>

#include "picture/camera.hpp"
#include "picture/render.hpp"
#include "picture/strokes.hpp"

namespace marrow {

/// Sizes that grow with the picture, in pixels.
struct Sizes {
  float dot;      // of the font
  float tube;     // radius
  float outline;  // around tubes and balls
  float joint, leaf;
  double disc;  // radius of a point
  int legend;   // height
};

struct Scene {
  Normalization pose;
  std::vector<View> views;
  Sizes sizes;
  Rect legend;  ///< of no height if there is none
};

/// Throws Error: Usage (size out of range).
Scene scene_of(const Shape& shape, const CurveSkeleton& skeleton, const RenderOptions& options);

/// Tubes for the edges, then balls for all nodes but those within branches.
std::vector<Stroke> strokes_of(const CurveSkeleton& skeleton, const Scene& scene, const View& view);

}  // namespace marrow
