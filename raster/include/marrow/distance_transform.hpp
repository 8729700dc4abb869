// The (3,4) chamfer distance transform of a silhouette (section 4.1).
#pragma once

#include <marrow/image.hpp>
#include <marrow/vote_grid.hpp>

namespace marrow {

/// At every pixel of the silhouette the distance to the background in thirds of a pixel: 3 at the
/// border, 0 outside.
using DistanceMap = Image<ChamferDistance>;

/// Steps cost 3 along rows and columns, 4 along diagonals; what lies outside the image is
/// background.
DistanceMap distance_transform(const BitImage& silhouette);

/// Radius in pixels of the disc at a pixel with this distance: the border runs half a pixel beyond
/// the centres of the outermost pixels.
inline double pixels_of(ChamferDistance distance) { return distance / 3.0 - 0.5; }

}  // namespace marrow
