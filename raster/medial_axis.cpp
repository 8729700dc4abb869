#include <marrow/medial_axis.hpp>

#include "thinning_detail.hpp"

namespace marrow {

MedialAxis::MedialAxis(const BitImage& axis, const DistanceMap& map) {
  for (int y = 0; y < axis.height(); ++y) {
    for (int x = 0; x < axis.width(); ++x)
      if (axis(x, y)) pixels_.push_back({static_cast<std::uint16_t>(x), map(x, y)});
    row_start_.push_back(pixels_.size());
  }
}

MedialAxis medial_axis(const DistanceMap& map, double prune_pixels) {
  PixelSet set = thin_to_medial_axis(map);
  prune_end_branches(set, map, prune_pixels);
  BitImage axis(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      if (set(x, y)) axis.set(x, y);
  return MedialAxis(axis, map);
}

BitImage to_image(const MedialAxis& axis, int side) {
  BitImage image(side, side);
  for (int y = 0; y < axis.rows(); ++y)
    for (const auto& p : axis.row(y)) image.set(p.x, y);
  return image;
}

}  // namespace marrow
