#include <marrow/medial_axis.hpp>

#include <bit>

#include "medial_axis_maker_detail.hpp"

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

MedialAxis MedialAxisMaker::operator()(const DistanceMap& map, double prune_pixels) {
  set_.assign(map);
  remove_sure(set_, doubtful_);
  thin_to_medial_axis(set_, order_);
  prune_end_branches(set_, prune_pixels);
  BitImage axis(map.width(), map.height());
  for (const auto p : pixels(set_)) axis.set(set_.x_of(p), set_.y_of(p));
  return MedialAxis(axis, map);
}

MedialAxis medial_axis(const DistanceMap& map, double prune_pixels) {
  return MedialAxisMaker()(map, prune_pixels);
}

BitImage to_image(const MedialAxis& axis, int side) {
  BitImage image(side, side);
  for (int y = 0; y < axis.rows(); ++y)
    for (const auto& p : axis.row(y)) image.set(p.x, y);
  return image;
}

}  // namespace marrow
