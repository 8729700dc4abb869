// The pixels that points fall in.
#pragma once

#include <marrow/image.hpp>

#include <utility>

namespace marrow {

/// The pixel of an image coordinate: floor(coordinate + 0.5) without a call.
inline int nearest(double coordinate) {
  const double up = coordinate + 0.5;
  const int cut = static_cast<int>(up);
  return cut - static_cast<int>(cut > up);
}

inline bool is_set(const BitImage& image, const std::pair<double, double>& at) {
  const int x = nearest(at.first), y = nearest(at.second);
  return image.contains(x, y) && image(x, y);
}

}  // namespace marrow
