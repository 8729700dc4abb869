#include <marrow/visual_hull.hpp>

#include <algorithm>
#include <cmath>

namespace marrow {

namespace {

constexpr double kMaskTolerance = 1;     // pixels
constexpr double kAxisTolerance = 0.9;   // voxels
constexpr double kBroadTolerance = 0.2;  // of the radius: medial axes of thick parts differ more
constexpr int kMajority = 14;            // of 27

int nearest(double coordinate) { return static_cast<int>(std::floor(coordinate + 0.5)); }

bool is_set(const BitImage& image, const std::pair<double, double>& at) {
  const int x = nearest(at.first), y = nearest(at.second);
  return image.contains(x, y) && image(x, y);
}

/// target[i] = sum of source over i - stride, i, i + stride.
void sum_three(const std::vector<std::uint8_t>& source, std::vector<std::uint8_t>& target,
               std::size_t stride) {
  const std::size_t n = source.size();
  for (std::size_t i = stride; i + stride < n; ++i)
    target[i] = static_cast<std::uint8_t>(source[i - stride] + source[i] + source[i + stride]);
}

}  // namespace

/// The grid's padding keeps the set off its faces, so that sums that wrap around see zeros only.
VoxelSet majority(const VoxelGrid& grid, const VoxelSet& set) {
  const auto nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
  VoxelSet a(set.size(), 0), b(set.size(), 0);
  sum_three(set, a, 1);
  sum_three(a, b, nx);
  sum_three(b, a, nx * ny);
  for (auto& count : a) count = count >= kMajority;
  return a;
}

Projections::Projections(std::span<const StereoImages> views) {
  for (const auto& view : views)
    for (const auto* image : {&view.front, &view.side}) {
      const PixelGrid pixels{image->silhouette.width()};
      const double scale = 1 / pixels.pixel();
      images_.push_back(image);
      planes_.push_back({image->plane.u * scale, image->plane.v * scale});
      middle_ = pixels.to_pixels(0);
    }
}

VoteGrid clean_grid(VoteGrid votes, std::span<const StereoImages> views) {
  const Projections project(views);
  std::vector<BitImage> masks;
  for (std::size_t i = 0; i < project.image_count(); ++i)
    masks.push_back(dilate(project.image(i).silhouette, kMaskTolerance));
  const double pixel = PixelGrid{masks[0].width()}.pixel();
  const double tolerance = std::max(kAxisTolerance * votes.grid.size / pixel, 1.0);
  std::vector<Vote> kept;
  kept.reserve(votes.votes.size());
  for (Vote vote : votes.votes) {
    const double broad = std::max(tolerance, kBroadTolerance * pixels_of(vote.radius));
    bool inside = true;
    for (std::size_t i = 0; i < masks.size() && inside; ++i) {
      const auto at = project(i, vote.position);
      inside = is_set(masks[i], at);
      if (!inside) break;
      const double away = project.image(i).to_axis(nearest(at.first), nearest(at.second)) / 3.0;
      if (away <= tolerance) ++vote.support;
      if (away <= broad) ++vote.broad_support;
    }
    if (inside) kept.push_back(vote);
  }
  votes.votes = std::move(kept);
  return votes;
}

VoxelSet hull_solid(const VoxelGrid& grid, std::span<const StereoImages> views) {
  const Projections project(views);
  VoxelSet solid(grid.count(), 0);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(grid.nx));
  for (int z = 1; z < grid.nz - 1; ++z)
    for (int y = 1; y < grid.ny - 1; ++y) {
      std::fill(row.begin(), row.end(), std::uint8_t{1});
      const Vec3 first = grid.center(grid.index(0, y, z));
      for (std::size_t i = 0; i < project.image_count(); ++i) {
        const BitImage& mask = project.image(i).silhouette;
        const auto [u0, v0] = project(i, first);
        const auto [u1, v1] = project(i, first + Vec3{grid.size, 0, 0});
        bool any = false;
        for (int x = 0; x < grid.nx; ++x) {
          auto& inside = row[static_cast<std::size_t>(x)];
          if (inside && !is_set(mask, {u0 + x * (u1 - u0), v0 + x * (v1 - v0)})) inside = 0;
          any |= inside != 0;
        }
        if (!any) break;
      }
      std::copy(row.begin() + 1, row.end() - 1, solid.begin() + grid.index(1, y, z));
    }
  return solid;
}

double hull_radius(const Vec3& p, const Projections& projections) {
  double least = 1e300, pixel = 0;
  for (std::size_t i = 0; i < projections.image_count(); ++i) {
    const DistanceMap& map = projections.image(i).distance;
    pixel = PixelGrid{map.width()}.pixel();
    const auto [u, v] = projections(i, p);
    const int x = std::clamp(static_cast<int>(std::floor(u)), 0, map.width() - 2);
    const int y = std::clamp(static_cast<int>(std::floor(v)), 0, map.height() - 2);
    const double s = std::clamp(u - x, 0.0, 1.0), t = std::clamp(v - y, 0.0, 1.0);
    const double top = map(x, y) * (1 - s) + map(x + 1, y) * s;
    const double bottom = map(x, y + 1) * (1 - s) + map(x + 1, y + 1) * s;
    least = std::min(least, (top * (1 - t) + bottom * t) / 3.0 - 0.5);
  }
  return least * pixel;
}

}  // namespace marrow
