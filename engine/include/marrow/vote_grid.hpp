// The voxel grid that the matches of all views vote in (section 4.2).
#pragma once

#include <marrow/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace marrow {

/// A distance in an image in thirds of a pixel; integer until the skeleton is built.
using ChamferDistance = std::uint16_t;

/// A box of cubic voxels; x runs fastest.
struct VoxelGrid {
  Vec3 origin;      ///< lowest corner
  double size = 1;  ///< edge of a voxel
  int nx = 0, ny = 0, nz = 0;

  std::size_t count() const {
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
           static_cast<std::size_t>(nz);
  }
  std::uint32_t index(int x, int y, int z) const {
    return static_cast<std::uint32_t>(x + nx * (y + ny * z));
  }
  bool contains(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz;
  }
  int x_of(std::uint32_t voxel) const { return static_cast<int>(voxel) % nx; }
  int y_of(std::uint32_t voxel) const { return static_cast<int>(voxel) / nx % ny; }
  int z_of(std::uint32_t voxel) const { return static_cast<int>(voxel) / nx / ny; }
  Vec3 center(int x, int y, int z) const { return origin + Vec3{x + 0.5, y + 0.5, z + 0.5} * size; }
  Vec3 center(std::uint32_t voxel) const { return center(x_of(voxel), y_of(voxel), z_of(voxel)); }

  friend bool operator==(const VoxelGrid&, const VoxelGrid&) = default;
};

/// The grid around a box: `resolution` voxels along its longest side, at least two of padding on
/// every side, and an odd number along each, so that the middle plane of a symmetric shape runs
/// through voxel centres and not between two layers that are equally good.
VoxelGrid make_voxel_grid(const Vec3& low, const Vec3& high, int resolution);

/// What the matches in one voxel say.
struct Vote {
  std::uint32_t voxel = 0;
  std::uint32_t count = 0;         ///< matches
  ChamferDistance radius = 0;      ///< least of the distances matched here
  std::uint8_t support = 0;        ///< of 42: the share of the images whose medial axis passes
  std::uint8_t broad_support = 0;  ///< the same, with a tolerance that grows with the radius
  Vec3 position;                   ///< mean of the exact positions matched here

  friend bool operator==(const Vote&, const Vote&) = default;
};

/// All voted voxels, in the order of their index.
struct VoteGrid {
  VoxelGrid grid;
  std::vector<Vote> votes;

  friend bool operator==(const VoteGrid&, const VoteGrid&) = default;
};

/// A front and a side medial pixel on one scanline, and what both see.
struct Match {
  Vec3 position;               ///< inside the grid, every coordinate less than 2 from 0
  ChamferDistance radius = 0;  ///< the lesser of the two distances
};

/// Takes votes from many threads at once into one grid of atomic cells: integer add and min only,
/// which commute, so that any schedule gives the same grid.
class VoteAccumulator {
 public:
  explicit VoteAccumulator(const VoxelGrid& grid);
  ~VoteAccumulator();

  /// One vote for each of the matches. Thread-safe; the more at once, the cheaper.
  void vote(std::span<const Match> matches);

  /// The end of the parallel phase is a change of type.
  VoteGrid finish() &&;

 private:
  class Cells;

  VoxelGrid grid_;
  std::unique_ptr<Cells> cells_;
};

}  // namespace marrow
