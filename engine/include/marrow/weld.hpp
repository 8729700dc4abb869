// Points at the same place are one.
#pragma once

#include <marrow/vec.hpp>

#include <cstdint>
#include <vector>

namespace marrow {

/// For every point the first one that stands at the same place.
std::vector<std::uint32_t> welded_points(const std::vector<Vec3>& points);

}  // namespace marrow
