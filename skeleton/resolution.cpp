#include <marrow/resolution.hpp>

#include <algorithm>
#include <vector>

namespace marrow {

namespace {

constexpr double kThinShape = 2;  // voxels: a lower quartile of radii under this
constexpr double kThinParts = 1;  // pixels: a lower twentieth of radii under this
constexpr int kFinestGrid = 192;  // voxels along the longest side

/// The radii of all medial pixels of all images.
class Radii {
 public:
  explicit Radii(std::span<const StereoImages> views) : histogram_(std::size_t{1} << 16, 0) {
    for (const auto& view : views)
      for (const auto* image : {&view.front, &view.side})
        for (const auto& p : image->axis.pixels()) ++histogram_[p.distance], ++total_;
  }

  bool empty() const { return total_ == 0; }

  /// The least radius, in pixels, that one of `parts` equal parts of all radii does not exceed.
  double lowest(std::size_t parts) const {
    std::size_t seen = 0, d = 0;
    while ((seen += histogram_[d]) * parts < total_) ++d;
    return pixels_of(static_cast<ChamferDistance>(d));
  }

 private:
  std::vector<std::size_t> histogram_;  // by chamfer distance
  std::size_t total_ = 0;
};

int finer_grid(int grid, double voxels) {
  return std::max(grid, std::min(kFinestGrid, static_cast<int>(voxels)));
}

}  // namespace

Resolution resolution_for(const Vec3& low, const Vec3& high, std::span<const StereoImages> views,
                          Resolution first, int finest_image) {
  const Radii radii(views);
  if (radii.empty()) return first;
  const double voxel = make_voxel_grid(low, high, first.grid).size;
  const double quartile = radii.lowest(4) * PixelGrid{first.image}.pixel() / voxel;  // voxels
  if (quartile < kThinShape)
    return {first.image, finer_grid(first.grid, first.grid * kThinShape / std::max(quartile, 0.1))};
  if (radii.lowest(20) < kThinParts && 2 * first.image <= finest_image)
    return {2 * first.image, finer_grid(first.grid, 1.5 * first.grid)};
  return first;
}

}  // namespace marrow
