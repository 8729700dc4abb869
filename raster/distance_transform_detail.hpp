// What the kernels of the distance transform are given.
#pragma once

#include <marrow/distance_transform.hpp>

#include <cstddef>

namespace marrow {

/// Kernels walk along rows in blocks of pixels, a byte of the silhouette each.
constexpr int kBlock = 8;

/// A box of an image whose distances are asked for. Its left side is a multiple of kBlock, its
/// right one too or the edge of the image.
struct DistanceTask {
  const BitImage* silhouette;
  PixelBox box;
  PixelBox rim;  ///< pixels of the silhouette from each side of the box to the background
  ChamferDistance* target;  ///< where the upper left corner of the box goes
  std::ptrdiff_t stride;    ///< of the rows of the target
};

}  // namespace marrow
