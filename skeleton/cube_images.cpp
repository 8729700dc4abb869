#include <cmath>

#include "cube_images_detail.hpp"

namespace marrow {

namespace {

constexpr double kSlack = 0.01;  // pixels; more than rounding can make of a cube's extent

}  // namespace

AffineMap::AffineMap(const VoxelGrid& grid, const Projections& project, std::size_t image) {
  const Vec3 first = grid.center(0);
  const auto [u, v] = project(image, first);
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const std::array<int, 3> voxels{grid.nx, grid.ny, grid.nz};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [u1, v1] = project(image, first + axes[a] * grid.size);
    du_[a] = u1 - u, dv_[a] = v1 - v;
    for (int k = 0; k < voxels[a]; k += kBlockSide) blocks_[a].emplace_back(du_[a] * k, dv_[a] * k);
  }
  for (auto& z : blocks_[2]) z = z + FixedPoint::nearest(u, v);
}

std::pair<double, double> AffineMap::reach(int side) const {
  const double half = 0.5 * (side - 1);
  return {half * (std::abs(du_[0]) + std::abs(du_[1]) + std::abs(du_[2])),
          half * (std::abs(dv_[0]) + std::abs(dv_[1]) + std::abs(dv_[2]))};
}

CubeImages::CubeImages(const BitImage& mask, const std::pair<double, double>& reach)
    : rx(static_cast<int>(std::ceil(reach.first + kSlack))),
      ry(static_cast<int>(std::ceil(reach.second + kSlack))),
      some(dilate_box(mask, rx, ry)),
      all(erode_box(mask, rx, ry)) {}

}  // namespace marrow
