// Cleaning by the visual hull (section 4.3), and how many images support a vote.
#pragma once

#include <marrow/stereo_images.hpp>
#include <marrow/vote_grid.hpp>
#include <marrow/voxel_set.hpp>

#include <span>
#include <utility>
#include <vector>

namespace marrow {

/// Where a point of the normalised frame falls in every image of all views.
class Projections {
 public:
  explicit Projections(std::span<const StereoImages> views);

  std::size_t image_count() const { return images_.size(); }
  const ViewImage& image(std::size_t i) const { return *images_[i]; }
  /// Image coordinates of `p` in image `i`; pixel centres are integers.
  std::pair<double, double> operator()(std::size_t i, const Vec3& p) const {
    return {dot(planes_[i].u, p) + middle_, dot(planes_[i].v, p) + middle_};
  }
  /// The axes of image `i`, scaled to pixels, and where the origin falls along both.
  const ViewPlane& plane(std::size_t i) const { return planes_[i]; }
  double middle() const { return middle_; }

 private:
  std::vector<const ViewImage*> images_;
  std::vector<ViewPlane> planes_;  // scaled to pixels
  double middle_ = 0;
};

/// Drops every vote whose mean position falls outside a silhouette by more than a pixel, and gives
/// the others their support: the images whose medial axis passes within 0.9 voxels (at least a
/// pixel), in 42nds of all. The broad support allows a fifth of the radius.
VoteGrid clean_grid(const VoteGrid& votes, std::span<const StereoImages> views);

/// The paper's own cleaning: drops every vote whose voxel has its centre outside a silhouette,
/// moves the others there, and lets all of them have full support, so that the number of their
/// matches ranks them.
VoteGrid clean_grid_by_centres(const VoteGrid& votes, std::span<const StereoImages> views);

/// Voxels whose centre lies inside all silhouettes, without the outermost layer of the grid, which
/// lies around the unit ball.
VoxelSet hull_solid(const VoxelGrid& grid, std::span<const StereoImages> views);

/// A majority vote of 3x3x3 neighbours (14 of 27): without it noise on the surface opens tunnels.
/// No voxel of `set` may lie on the outermost layer.
VoxelSet majority(const VoxelGrid& grid, const VoxelSet& set);

/// Radius of the ball around `p` that the silhouettes allow: the least of the distances at its
/// projections, bilinear. Normalised frame; may be negative outside the hull.
double hull_radius(const Vec3& p, const Projections& projections);

}  // namespace marrow
