// Points spread over a surface.
#pragma once

#include <marrow/normalization.hpp>

#include <cstddef>
#include <vector>

namespace marrow {

/// `count` points over the triangles of a mesh, as dense everywhere; of a cloud, evenly many of its
/// points, `count` at most. None of a mesh without area.
std::vector<Vec3> surface_samples(const NormalizedShape& shape, std::size_t count);

}  // namespace marrow
