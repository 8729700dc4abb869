// The silhouettes of oriented surfaces by their contours.
#pragma once

#include <marrow/silhouette.hpp>

namespace marrow {

/// draw_silhouettes() of an oriented shape; `neighbours` are its edge_neighbours().
std::vector<BitImage> draw_by_contours(const NormalizedShape& shape,
                                       std::span<const Triangle> neighbours,
                                       std::span<const ViewPlane> planes, int resolution,
                                       const ForEach& for_each);

}  // namespace marrow
