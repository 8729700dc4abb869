// The (3,4) chamfer distance transform of a silhouette (section 4.1).
#pragma once

#include <marrow/image.hpp>
#include <marrow/vote_grid.hpp>

#include <utility>

namespace marrow {

/// At every pixel of the silhouette the distance to the background in thirds of a pixel: 3 at the
/// border, 0 outside.
using DistanceMap = Image<ChamferDistance>;

/// Steps cost 3 along rows and columns, 4 along diagonals; what lies outside the image is
/// background. Sides are at most 4096 pixels.
DistanceMap distance_transform(const BitImage& silhouette);

/// The distances in a part of an image.
class BoxedDistanceMap {
 public:
  BoxedDistanceMap() = default;
  BoxedDistanceMap(const PixelBox& box, DistanceMap map) : box_(box), map_(std::move(map)) {}

  const PixelBox& box() const { return box_; }
  /// At a pixel of the image; outside the box greater than any distance.
  ChamferDistance operator()(int x, int y) const {
    const int across = x - box_.left, down = y - box_.top;
    const bool is_inside =
        across >= 0 && down >= 0 && across < map_.width() && down < map_.height();
    return is_inside ? map_(across, down) : ChamferDistance{0xffff};
  }
  /// Row `y` of the image, which the box must hold, from the left side of the box on.
  const ChamferDistance* row(int y) const { return map_.row(y - box_.top); }

  friend bool operator==(const BoxedDistanceMap&, const BoxedDistanceMap&) = default;

 private:
  PixelBox box_;
  DistanceMap map_;
};

/// The distances in `box`, and some around it, as if the silhouette held all pixels outside.
BoxedDistanceMap distance_transform(const BitImage& silhouette, const PixelBox& box);

/// Radius in pixels of the disc at a pixel with this distance: the border runs half a pixel beyond
/// the centres of the outermost pixels.
inline double pixels_of(ChamferDistance distance) { return distance / 3.0 - 0.5; }

}  // namespace marrow
