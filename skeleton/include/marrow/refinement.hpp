// Recentring on the surface: what images promise is made exact (ours, in place of the paper's end).
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/surface_scene.hpp>
#include <marrow/visual_hull.hpp>

namespace marrow {

/// How the last stage ends.
enum class Refinement {
  None,     ///< the paper's end: smoothed branches, radii of the matches
  Hull,     ///< the same lines, radii of the balls that the 42 silhouettes allow
  Surface,  ///< lines in the middle of the surface, radii exact; where there is no surface: Hull
};

/// What recentring asks, all in the normalised frame.
struct RefinementInput {
  const NormalizedShape& shape;
  const SurfaceScene& surface;  ///< of the shape
  const Projections& projections;
  double pixel = 0;  ///< of the images
};

/// The same graph in the middle of the surface, in the normalised frame: branches are sampled anew,
/// every node moves to where opposite walls are as far, held by the stiffness of its branch; leaves
/// run on to where their ball touches the end. Joints go to where their limbs point to.
/// `radius` is the distance to the
/// surface, `section_radius` the mean half width of the section, up to half more. Components,
/// cycles and leaves stay what they are, whatever the surface: open, with holes, or a soup.
CurveSkeleton recentre(const CurveSkeleton& skeleton, const RefinementInput& input);

}  // namespace marrow
