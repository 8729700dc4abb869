#include <marrow/resolution.hpp>

#include "catch.hpp"

using namespace marrow;

namespace {

constexpr int kSide = 64;
const Vec3 kLow{-0.5, -1, -0.25}, kHigh{0.5, 1, 0.25};

ChamferDistance thirds(double pixels) {
  return static_cast<ChamferDistance>(3 * (pixels + 0.5) + 0.5);
}

/// One pair whose front image has one medial pixel for each radius, in pixels.
std::vector<StereoImages> views_with(const std::vector<double>& radii) {
  BitImage axis(kSide, kSide);
  DistanceMap map(kSide, kSide);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const int x = static_cast<int>(i);
    axis.set(x, 9);
    map(x, 9) = thirds(radii[i]);
  }
  std::vector<StereoImages> views(1);
  views[0].front.axis = MedialAxis(axis, map);
  return views;
}

/// `thin` of 40 medial pixels have the first radius, the others the second.
std::vector<StereoImages> views_with(std::size_t thin, double thin_radius, double thick_radius) {
  std::vector<double> radii(40, thick_radius);
  for (std::size_t i = 0; i < thin; ++i) radii[i] = thin_radius;
  return views_with(radii);
}

Resolution resolution(const std::vector<StereoImages>& views, int grid, int finest_image = 1024) {
  return resolution_for(kLow, kHigh, views, {kSide, grid}, finest_image);
}

/// The length of a voxel in pixels.
double voxel(int grid) {
  return make_voxel_grid(kLow, kHigh, grid).size / PixelGrid{kSide}.pixel();
}

}  // namespace

TEST_CASE("a thick shape, or none, keeps the resolution", "[resolution]") {
  CHECK(resolution(views_with({}), 32) == Resolution{kSide, 32});
  CHECK(resolution(views_with(0, 0, 5 * voxel(32)), 32) == Resolution{kSide, 32});
}

TEST_CASE("a shape that is thin as a whole gets a finer grid", "[resolution]") {
  const auto with_radius = [&](double voxels, int grid) {
    return resolution(views_with({voxels * voxel(grid)}), grid);
  };
  CHECK(with_radius(1, 32).image == kSide);
  CHECK(with_radius(1, 32).grid > 48);
  CHECK(with_radius(1, 32).grid < 96);
  CHECK(with_radius(0.01, 150) == Resolution{kSide, 192});
  CHECK(with_radius(0.01, 220) == Resolution{kSide, 220});
}

TEST_CASE("a quarter that is thin makes the shape thin", "[resolution]") {
  CHECK(resolution(views_with(9, voxel(32), 9 * voxel(32)), 32) == Resolution{kSide, 32});
  CHECK(resolution(views_with(10, voxel(32), 9 * voxel(32)), 32).grid > 32);
}

TEST_CASE("small parts thinner than a pixel get finer images and a finer grid", "[resolution]") {
  const double thick = 9 * voxel(32);
  CHECK(resolution(views_with(2, 0.5, thick), 32) == Resolution{2 * kSide, 48});
  CHECK(resolution(views_with(2, 0.5, thick), 140) == Resolution{2 * kSide, 192});
  CHECK(resolution(views_with(1, 0.5, thick), 32) == Resolution{kSide, 32});
  CHECK(resolution(views_with(2, 1.5, thick), 32) == Resolution{kSide, 32});
  SECTION("but no finer images than are asked for") {
    CHECK(resolution(views_with(2, 0.5, thick), 32, 2 * kSide - 1) == Resolution{kSide, 32});
  }
}
