// From moments to a frame, the same rules for surfaces and volumes.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <functional>

#include "eigen_detail.hpp"

namespace marrow {

/// Central third moments along two directions.
using ThirdMoments = std::function<std::array<double, 2>(const std::array<Vec3, 2>&)>;

/// The principal frame of these second moments: y the greatest, z the least. The signs of y and x
/// make the third moments positive; see normalize() for ties.
Frame principal_frame(const SymmetricMatrix& covariance, const ThirdMoments& third_moments);

}  // namespace marrow
