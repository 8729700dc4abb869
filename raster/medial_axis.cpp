#include <marrow/medial_axis.hpp>

#include <algorithm>

#include "thinning_detail.hpp"

namespace marrow {

namespace {

/// `map` with a rim of background one pixel wide, so that every pixel of the silhouette has all its
/// neighbours, also where it touches the edge of the image.
DistanceMap with_rim(const DistanceMap& map) {
  DistanceMap result(map.width() + 2, map.height() + 2);
  for (int y = 0; y < map.height(); ++y)
    std::copy_n(map.row(y), map.width(), result.row(y + 1) + 1);
  return result;
}

}  // namespace

MedialAxis::MedialAxis(const BitImage& axis, const DistanceMap& map) {
  for (int y = 0; y < axis.height(); ++y) {
    for (int x = 0; x < axis.width(); ++x)
      if (axis(x, y)) pixels_.push_back({static_cast<std::uint16_t>(x), map(x, y)});
    row_start_.push_back(pixels_.size());
  }
}

MedialAxis medial_axis(const DistanceMap& map, double prune_pixels) {
  const DistanceMap padded = with_rim(map);
  PixelSet set = thin_to_medial_axis(padded);
  prune_end_branches(set, padded, prune_pixels);
  BitImage axis(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      if (set(x + 1, y + 1)) axis.set(x, y);
  return MedialAxis(axis, map);
}

BitImage to_image(const MedialAxis& axis, int side) {
  BitImage image(side, side);
  for (int y = 0; y < axis.rows(); ++y)
    for (const auto& p : axis.row(y)) image.set(p.x, y);
  return image;
}

}  // namespace marrow
