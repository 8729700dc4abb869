#include <marrow/stereo_matching.hpp>

#include <algorithm>
#include <cmath>

namespace marrow {

namespace {

constexpr double kThin = 2;  // voxels: a quantile of radii under this asks for a finer grid
constexpr int kFinestAdaptive = 192;  // voxels along the longest side

/// The 25 % quantile of the radii of all medial pixels, in pixels.
double lower_quartile_of_radii(std::span<const StereoImages> views) {
  std::vector<std::size_t> histogram(std::size_t{1} << 16, 0);
  std::size_t total = 0;
  for (const auto& view : views)
    for (const auto* image : {&view.front, &view.side})
      for (const auto& p : image->axis.pixels()) ++histogram[p.distance], ++total;
  std::size_t seen = 0;
  for (std::size_t d = 0; d < histogram.size(); ++d) {
    seen += histogram[d];
    if (4 * seen >= total && total > 0) return pixels_of(static_cast<ChamferDistance>(d));
  }
  return 0;
}

}  // namespace

VoxelGrid choose_voxel_grid(const NormalizedShape& shape, std::span<const StereoImages> views,
                            int resolution) {
  const VoxelGrid grid = make_voxel_grid(shape.low, shape.high, resolution);
  if (views.empty() || resolution >= kFinestAdaptive) return grid;
  const PixelGrid pixels{views[0].front.silhouette.width()};
  const double quartile = lower_quartile_of_radii(views) * pixels.pixel() / grid.size;  // voxels
  if (quartile >= kThin) return grid;
  const double finer = resolution * kThin / std::max(quartile, 0.1);
  return make_voxel_grid(shape.low, shape.high, std::min(kFinestAdaptive, static_cast<int>(finer)));
}

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
