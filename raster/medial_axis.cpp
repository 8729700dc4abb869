#include <marrow/medial_axis.hpp>

#include <bit>

#include "thinning_detail.hpp"

namespace marrow {

MedialAxis::MedialAxis(const BitImage& axis, const DistanceMap& map) {
  row_start_.reserve(static_cast<std::size_t>(axis.height()) + 1);
  pixels_.reserve(count(axis));
  for (int y = 0; y < axis.height(); ++y) {
    for (int i = 0; i < axis.words_per_row(); ++i)
      for (auto word = axis.row(y)[i]; word != 0; word &= word - 1) {
        const int x = 64 * i + std::countr_zero(word);
        pixels_.push_back({static_cast<std::uint16_t>(x), map(x, y)});
      }
    row_start_.push_back(pixels_.size());
  }
}

MedialAxis medial_axis(const DistanceMap& map, double prune_pixels) {
  ShrinkingSet set(map);
  thin_to_medial_axis(set);
  prune_end_branches(set, prune_pixels);
  BitImage axis(map.width(), map.height());
  for (const auto p : pixels(set)) axis.set(set.x_of(p), set.y_of(p));
  return MedialAxis(axis, map);
}

BitImage to_image(const MedialAxis& axis, int side) {
  BitImage image(side, side);
  for (int y = 0; y < axis.rows(); ++y)
    for (const auto& p : axis.row(y)) image.set(p.x, y);
  return image;
}

}  // namespace marrow
