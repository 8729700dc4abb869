#include <marrow/stereo_matching.hpp>

#include <algorithm>

namespace marrow {

void cast_votes(const StereoImages& images, VoteAccumulator& accumulator) {
  const Frame& f = images.pair.frame;
  const PixelGrid pixels{images.front.silhouette.width()};
  for (int row = 0; row < images.front.axis.rows(); ++row) {
    const auto side_row = images.side.axis.row(row);
    if (side_row.empty()) continue;
    const Vec3 along = f.y * pixels.to_length(row);
    for (const auto& front : images.front.axis.row(row)) {
      const Vec3 line = along + f.x * pixels.to_length(front.x);
      for (const auto& side : side_row)
        accumulator.vote(line + f.z * pixels.to_length(side.x),
                         std::min(front.distance, side.distance));
    }
  }
}

}  // namespace marrow
