// Arrays of numpy as shapes, volumes and skeletons.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>
#include <marrow/volume.hpp>

#include <pybind11/numpy.h>

#include <cstdint>

namespace marrow {

using Doubles = pybind11::array_t<double, pybind11::array::forcecast>;
using Indices = pybind11::array_t<std::int64_t, pybind11::array::forcecast>;

/// A shape of `vertices`, n x 3, and `faces`, m x k with k >= 3: polygons of k corners are cut into
/// triangles. Without faces it is a point cloud. Throws Error: Usage, Malformed.
Shape shape_of(const Doubles& vertices, const Indices* faces);

/// Foreground where `values`, indexed [x, y, z] and of any real type, are greater than `iso`. The
/// centre of voxel (0, 0, 0) is at `origin`. Reads the array where it is, whatever its strides.
/// Throws Error: Usage, Limit, Unsupported.
Volume volume_of(const pybind11::array& values, double iso, const Vec3& spacing,
                 const Vec3& origin);

/// A skeleton of nodes, n x 3, radii, n, edges, m x 2, and section radii, n or none. Throws Error:
/// Usage, Malformed.
CurveSkeleton skeleton_of(const Doubles& nodes, const Doubles& radii, const Indices& edges,
                          const Doubles* section_radii);

}  // namespace marrow
