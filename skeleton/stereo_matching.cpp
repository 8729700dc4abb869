#include <marrow/stereo_matching.hpp>

#include <algorithm>

namespace marrow {

namespace {

constexpr std::size_t kBatch = 1 << 14;  // matches that are handed over at once

}  // namespace

void cast_votes(const StereoImages& images, VoteAccumulator& accumulator) {
  const Frame& f = images.pair.frame;
  const PixelGrid pixels{images.front.silhouette.width()};
  std::vector<Match> matches;
  for (int row = 0; row < images.front.axis.rows(); ++row) {
    const auto side_row = images.side.axis.row(row);
    if (side_row.empty()) continue;
    const Vec3 along = f.y * pixels.to_length(row);
    for (const auto& front : images.front.axis.row(row)) {
      const Vec3 line = along + f.x * pixels.to_length(front.x);
      for (const auto& side : side_row)
        matches.push_back(
            {line + f.z * pixels.to_length(side.x), std::min(front.distance, side.distance)});
    }
    if (matches.size() < kBatch) continue;
    accumulator.vote(matches);
    matches.clear();
  }
  accumulator.vote(matches);
}

}  // namespace marrow
