#include <marrow/visual_hull.hpp>
#include <marrow/vote_graph.hpp>

#include <algorithm>
#include <cmath>

#include "projection_detail.hpp"
#include "vote_support_detail.hpp"

namespace marrow {

namespace {

constexpr double kMaskTolerance = 1;     // pixels
constexpr double kAxisTolerance = 0.9;   // voxels
constexpr double kBroadTolerance = 0.2;  // of the radius: medial axes of thick parts differ more

/// The greatest distance in thirds of a pixel that is within `tolerance` pixels.
int thirds_within(double tolerance) {
  int thirds = static_cast<int>(3 * tolerance) + 1;
  while (thirds / 3.0 > tolerance) --thirds;
  return thirds;
}

/// Images as 42nds of all; a whole threshold asks as much of the one as of the other.
std::uint8_t support_of(std::int32_t images, std::size_t all) {
  return static_cast<std::uint8_t>(static_cast<std::size_t>(images) * kImages / all);
}

}  // namespace

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

VoteGrid clean_grid(const VoteGrid& votes, std::span<const StereoImages> views) {
  const Projections project(views);
  std::vector<SupportImage> images;
  for (std::size_t i = 0; i < project.image_count(); ++i)
    images.emplace_back(project.image(i), dilate(project.image(i).silhouette, kMaskTolerance));
  const double pixel = PixelGrid{project.image(0).silhouette.width()}.pixel();
  const double tolerance = std::max(kAxisTolerance * votes.grid.size / pixel, 1.0);
  std::vector<Vec3> positions;
  std::vector<std::int32_t> broad;
  for (const Vote& vote : votes.votes) {
    positions.push_back(vote.position);
    broad.push_back(thirds_within(std::max(tolerance, kBroadTolerance * pixels_of(vote.radius))));
  }
  const auto support = vote_support(project, images, positions, thirds_within(tolerance), broad);
  VoteGrid cleaned{votes.grid, {}};
  for (std::size_t i = 0; i < support.size(); ++i) {
    if (!support[i].is_inside) continue;
    Vote vote = votes.votes[i];
    vote.support = support_of(support[i].narrow, images.size());
    vote.broad_support = support_of(support[i].broad, images.size());
    cleaned.votes.push_back(vote);
  }
  return cleaned;
}

VoteGrid clean_grid_by_centres(const VoteGrid& votes, std::span<const StereoImages> views) {
  const Projections project(views);
  VoteGrid cleaned{votes.grid, {}};
  for (Vote vote : votes.votes) {
    vote.position = votes.grid.center(vote.voxel);
    vote.support = vote.broad_support = kImages;
    bool inside = true;
    for (std::size_t i = 0; i < project.image_count() && inside; ++i) {
      const auto [u, v] = project(i, vote.position);
      inside = is_set(project.image(i).silhouette, {u, v});
    }
    if (inside) cleaned.votes.push_back(vote);
  }
  return cleaned;
}

double hull_radius(const Vec3& p, const Projections& projections) {
  double least = 1e300, pixel = 0;
  for (std::size_t i = 0; i < projections.image_count(); ++i) {
    const DistanceMap& map = projections.image(i).distance;
    pixel = PixelGrid{map.width()}.pixel();
    const auto [u, v] = projections(i, p);
    const int x = std::clamp(static_cast<int>(u), 0, map.width() - 2);
    const int y = std::clamp(static_cast<int>(v), 0, map.height() - 2);
    const double s = std::clamp(u - x, 0.0, 1.0), t = std::clamp(v - y, 0.0, 1.0);
    const double top = map(x, y) * (1 - s) + map(x + 1, y) * s;
    const double bottom = map(x, y + 1) * (1 - s) + map(x + 1, y + 1) * s;
    least = std::min(least, (top * (1 - t) + bottom * t) / 3.0 - 0.5);
  }
  return least * pixel;
}

}  // namespace marrow
