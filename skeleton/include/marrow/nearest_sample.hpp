// How far the points of a cloud are from places within it.
#pragma once

#include <marrow/normalization.hpp>

#include <span>
#include <vector>

namespace marrow {

/// For every place the distance to the nearest point of the cloud, normalised frame.
std::vector<double> nearest_samples(const NormalizedShape& cloud, std::span<const Vec3> places);

/// The same distances in the spacings of these nearest points.
std::vector<double> sample_depths(const NormalizedShape& cloud, std::span<const Vec3> places);

}  // namespace marrow
