// How densely a point cloud is sampled, point by point (section 5.1).
#pragma once

#include <marrow/shape.hpp>

#include <vector>

namespace marrow {

/// For every point of a cloud the distance to its eighth nearest neighbour, in the units of the
/// shape, but no more than what 95 % of all points keep to. 0 for a point that stands where an
/// earlier one does: it does not count. Empty for a shape with triangles.
std::vector<double> point_spacing(const Shape& shape);

}  // namespace marrow
