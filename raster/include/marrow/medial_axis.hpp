// The medial axis of a silhouette (section 4.1).
#pragma once

#include <marrow/distance_transform.hpp>

#include <span>
#include <vector>

namespace marrow {

/// A pixel of the medial axis and its distance to the background in thirds of a pixel.
struct MedialPixel {
  std::uint16_t x = 0;
  ChamferDistance distance = 0;

  friend bool operator==(const MedialPixel&, const MedialPixel&) = default;
};

/// Medial pixels row by row, from left to right: the scanlines that matching walks along.
class MedialAxis {
 public:
  MedialAxis() = default;
  /// The pixels set in `axis`, with their distances from `map`.
  MedialAxis(const BitImage& axis, const DistanceMap& map);

  int rows() const { return static_cast<int>(row_start_.size()) - 1; }
  std::span<const MedialPixel> row(int y) const {
    return std::span(pixels_).subspan(
        row_start_[static_cast<std::size_t>(y)],
        row_start_[static_cast<std::size_t>(y) + 1] - row_start_[static_cast<std::size_t>(y)]);
  }
  std::span<const MedialPixel> pixels() const { return pixels_; }

  friend bool operator==(const MedialAxis&, const MedialAxis&) = default;

 private:
  std::vector<std::size_t> row_start_{0};
  std::vector<MedialPixel> pixels_;
};

inline constexpr double kPrunePixels = 3;

/// The medial axis: homotopic thinning in the order of the distances with the centres of maximal
/// discs as anchors, brought to unit width, and end branches pruned that tell less than
/// `prune_pixels` more of the silhouette than the disc where they begin. It has the topology of the
/// silhouette (8 for the set, 4 for the background), which may touch the edge of the image.
MedialAxis medial_axis(const DistanceMap& map, double prune_pixels = kPrunePixels);

/// The medial pixels as an image of `side` x `side`.
BitImage to_image(const MedialAxis& axis, int side);

}  // namespace marrow
