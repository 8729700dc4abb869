// Silhouettes of point clouds (section 5.1): discs that follow the density of the points.
#pragma once

#include <marrow/silhouette.hpp>

namespace marrow {

/// The silhouette of a point cloud. Around every point a disc as large as the spacing there, at
/// least a pixel, closes the gaps between neighbours; what the discs added on the outside of the
/// shape is taken away again but for a pixel; every point keeps its own pixel and those beside it.
/// Holes of an inscribed radius under 0.02 of the side are filled. All radii and
/// places are integers once the points are snapped; their order does not matter.
BitImage draw_point_silhouette(const NormalizedShape& cloud, const ViewPlane& plane,
                               int resolution);

}  // namespace marrow
