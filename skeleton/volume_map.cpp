#include <marrow/error.hpp>
#include <marrow/surface_map.hpp>
#include <marrow/volume_summary.hpp>

#include <bit>
#include <cmath>
#include <limits>

#include "surface_map_detail.hpp"

namespace marrow {

namespace {

/// The foreground of a volume and which voxels of it touch.
class VoxelGraph {
 public:
  VoxelGraph(const Volume& volume, double scale) : volume_(volume), scale_(scale) {
    for (int z = 0; z < volume.nz; ++z)
      for (int y = 0; y < volume.ny; ++y) {
        first_.push_back(static_cast<std::uint32_t>(voxels_.size()));
        for (int x = 0; x < volume.nx; ++x)
          if (volume(x, y, z)) voxels_.push_back({narrow(x), narrow(y), narrow(z)});
      }
  }

  std::size_t size() const { return voxels_.size(); }
  /// In units of voxels.
  Vec3 cell(std::uint32_t i) const {
    const auto& [x, y, z] = voxels_[i];
    return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
  }
  Vec3 position(std::uint32_t i) const { return volume_.to_world(cell(i)) * scale_; }

  template <class Visit>
  void for_each_neighbour(std::uint32_t i, const Visit& visit) const {
    const auto& [x0, y0, z0] = voxels_[i];
    for (int z = z0 - 1; z <= z0 + 1; ++z)
      for (int y = y0 - 1; y <= y0 + 1; ++y)
        for (int x = x0 - 1; x <= x0 + 1; ++x) {
          const bool is_other = x != x0 || y != y0 || z != z0;
          if (is_other && volume_.contains(x, y, z) && volume_(x, y, z)) visit(site(x, y, z));
        }
  }

 private:
  /// Sides are at most Volume::kLongestSide.
  static std::uint16_t narrow(int side) { return static_cast<std::uint16_t>(side); }

  std::uint32_t site(int x, int y, int z) const {
    const auto row = volume_.row(y, z);
    int before = 0;
    for (int w = 0; w < x / 64; ++w) before += std::popcount(row[static_cast<std::size_t>(w)]);
    const Volume::Word below = (Volume::Word{1} << (x % 64)) - 1;
    before += std::popcount(row[static_cast<std::size_t>(x / 64)] & below);
    return first_[static_cast<std::size_t>(y) +
                  static_cast<std::size_t>(volume_.ny) * static_cast<std::size_t>(z)] +
           static_cast<std::uint32_t>(before);
  }

  const Volume& volume_;
  double scale_;
  std::vector<std::array<std::uint16_t, 3>> voxels_;
  std::vector<std::uint32_t> first_;  // of every row
};

/// From world units times a scale into units of voxels.
class IntoCells {
 public:
  IntoCells(const Volume& volume, double scale) : origin_(volume.origin * scale) {
    const Vec3 x = volume.steps[0] * scale, y = volume.steps[1] * scale,
               z = volume.steps[2] * scale;
    const double determinant = dot(x, cross(y, z));
    rows_ = {cross(y, z) / determinant, cross(z, x) / determinant, cross(x, y) / determinant};
  }
  Vec3 operator()(const Vec3& p) const {
    const Vec3 q = p - origin_;
    return {dot(rows_[0], q), dot(rows_[1], q), dot(rows_[2], q)};
  }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> rows_;
};

bool is_foreground(const Volume& volume, const Vec3& cell) {
  const Vec3 p{std::floor(cell.x + 0.5), std::floor(cell.y + 0.5), std::floor(cell.z + 0.5)};
  const bool is_in_box =
      p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < volume.nx && p.y < volume.ny && p.z < volume.nz;
  return is_in_box && volume(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
}

/// Whether there is only foreground between two places, but for one voxel at either end: the lines
/// of a vessel that is thinner than that may run beside it.
bool is_free(const Volume& volume, const Vec3& from, const Vec3& to) {
  const double far = distance(from, to);
  const int steps = static_cast<int>(std::min(2 * far, 4.0 * Volume::kLongestSide));
  for (int i = 3; i < steps - 2; ++i)
    if (!is_foreground(volume, from + (to - from) * (i / static_cast<double>(steps)))) return false;
  return true;
}

}  // namespace

SurfaceMap map_surface(const Volume& volume, const CurveSkeleton& skeleton) {
  if (foreground_count(volume) > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::Limit, "more than 4294967295 foreground voxels; give a smaller volume");
  const double scale = common_scale(foreground_bounds(volume), skeleton);
  const VoxelGraph graph(volume, scale);
  const IntoCells into_cells(volume, scale);
  SurfaceMap map = map_sites(graph, skeleton, scale, [&](const Vec3& foot, std::uint32_t i) {
    return is_free(volume, into_cells(foot), graph.cell(i));
  });
  add_parts(map, skeleton);
  return map;
}

}  // namespace marrow
