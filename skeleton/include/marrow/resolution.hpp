// How fine the images and the voxel grid must be for a shape (not in the paper, which takes both
// as given).
#pragma once

#include <marrow/stereo_images.hpp>
#include <marrow/vote_grid.hpp>

#include <span>

namespace marrow {

/// Pixels along a side of every image, and voxels along the longest side of the shape.
struct Resolution {
  int image = 256, grid = 128;

  friend bool operator==(const Resolution&, const Resolution&) = default;
};

/// What the medial axes of a first look, `views` at `first`, ask for.
/// - Where a quarter of their pixels have a radius under two voxels, the shape is thin as a whole:
///   a finer grid, up to 192, in which its limbs are two voxels thick.
/// - Otherwise, where a twentieth have a radius under a pixel, small parts such as fingers are
///   thinner than the images show: images of twice the side, if that is not above `finest_image`,
///   and a grid finer by half, up to 192.
/// Never less than `first`. `low` and `high` bound the shape in the normalised frame.
Resolution resolution_for(const Vec3& low, const Vec3& high, std::span<const StereoImages> views,
                          Resolution first, int finest_image);

}  // namespace marrow
