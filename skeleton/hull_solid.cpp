// The voxels inside all silhouettes. Cubes of 4 and 2 voxels are looked up in the silhouettes made
// smaller and greater by what a cube can cover; only where these differ a voxel is looked up
// itself.
#include <marrow/visual_hull.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "cube_images_detail.hpp"
#include "projection_detail.hpp"

namespace marrow {

namespace {

using Word = VoxelSet::Word;

constexpr std::size_t kBoxImages = 8;  // that boxes of two blocks a side are looked up in

/// A block has 8 cubes and a cube 8 voxels, both counted x + 2 y + 4 z.
constexpr std::array<int, 8> kVoxelOfCube{0, 1, 4, 5, 16, 17, 20, 21};
constexpr std::array<int, 8> kCubeOfBlock{0, 2, 8, 10, 32, 34, 40, 42};
constexpr Word kCube = 0x33 | Word{0x33} << 16;

/// Takes what one silhouette does not hold out of blocks.
class Carver {
 public:
  Carver(const VoxelGrid& grid, const Projections& project, std::size_t image)
      : grid_(grid),
        project_(project),
        image_(image),
        mask_(project.image(image).silhouette),
        map_(grid, project, image),
        blocks_(mask_, map_.reach(kBlockSide)),
        cubes_(mask_, map_.reach(2)),
        to_centre_(map_.step(1.5, 1.5, 1.5)) {
    for (std::size_t i = 0; i < 8; ++i) {
      const auto x = static_cast<double>(i & 1), y = static_cast<double>(i >> 1 & 1),
                 z = static_cast<double>(i >> 2);
      to_voxel_[i] = map_.step(x, y, z);
      to_cube_[i] = map_.step(2 * x, 2 * y, 2 * z);
      to_cube_centre_[i] = map_.step(2 * x + 0.5, 2 * y + 0.5, 2 * z + 0.5);
    }
  }

  Place place_of(const Block& b) const { return blocks_.place_of(map_(b) + to_centre_); }

  /// What is left of a mixed block without the cubes that are outside.
  Word carve_cubes(const Block& b) const {
    const FixedPoint first = map_(b);
    if (!blocks_.has_whole(first + to_centre_)) return b.voxels;
    const Lookup some(cubes_.some);
    Word outside = 0;
    for (std::size_t i = 0; i < 8; ++i)
      outside |= (kCube & (some(first + to_cube_centre_[i]) - 1)) << kCubeOfBlock[i];
    return b.voxels & ~outside;
  }

  /// What is left of a mixed block without the voxels that are outside.
  Word carve_voxels(const Block& b) const {
    const FixedPoint first = map_(b);
    if (!blocks_.has_whole(first + to_centre_)) return carve_singly(b, b.voxels);
    const Lookup all(cubes_.all);
    Word left = b.voxels;
    for (std::size_t i = 0; i < 8; ++i)
      if ((left & kCube << kCubeOfBlock[i]) != 0 && all(first + to_cube_centre_[i]) == 0)
        left = carve_cube(b, first + to_cube_[i], left, i);
    return left;
  }

 private:
  /// What is left of a block after a look at the voxels of cube `i`.
  Word carve_cube(const Block& b, const FixedPoint& first, Word left, std::size_t i) const {
    const Lookup mask(mask_);
    const Word cube = kCube << kCubeOfBlock[i];
    Word inside = 0, ties = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const FixedPoint p = first + to_voxel_[k];
      ties |= p.ties();
      inside |= mask(p) << kVoxelOfCube[k];
    }
    if ((ties & FixedPoint::kTie) != 0) return (left & ~cube) | carve_singly(b, left & cube);
    return left & (~cube | inside << kCubeOfBlock[i]);
  }

  /// Those of the `voxels` of a block that are inside, each looked up by itself.
  Word carve_singly(const Block& b, Word voxels) const {
    const FixedPoint first = map_(b);
    Word left = 0;
    for (; voxels != 0; voxels &= voxels - 1) {
      const int bit = std::countr_zero(voxels), x = bit & 3, y = bit >> 2 & 3, z = bit >> 4;
      const auto cube = static_cast<std::size_t>(x / 2 + 2 * (y / 2) + 4 * (z / 2));
      const auto voxel = static_cast<std::size_t>(x % 2 + 2 * (y % 2) + 4 * (z % 2));
      const FixedPoint p = first + to_cube_[cube] + to_voxel_[voxel];
      const bool inside =
          (p.ties() & FixedPoint::kTie) != 0
              ? holds(kBlockSide * b.x0 + x, kBlockSide * b.y0 + y, kBlockSide * b.z0 + z)
              : mask_.contains(p.x(), p.y()) && mask_(p.x(), p.y());
      left |= Word{inside} << bit;
    }
    return left;
  }

  /// Whether the silhouette holds a voxel. Along a row of voxels the coordinates are those of the
  /// first plus a multiple of the step: rounding must not depend on how a voxel is come by.
  bool holds(int x, int y, int z) const {
    const Vec3 first = grid_.center(0, y, z);
    const auto [u0, v0] = project_(image_, first);
    const auto [u1, v1] = project_(image_, first + Vec3{grid_.size, 0, 0});
    return is_set(mask_, {u0 + x * (u1 - u0), v0 + x * (v1 - v0)});
  }

  const VoxelGrid& grid_;
  const Projections& project_;
  std::size_t image_;
  const BitImage& mask_;
  AffineMap map_;
  CubeImages blocks_, cubes_;
  FixedPoint to_centre_;  // of the block, from its first voxel
  std::array<FixedPoint, 8> to_cube_, to_cube_centre_, to_voxel_;
};

/// The voxels of 0 to count - 1 but the first and the last that lie in block `b`: 4 bits.
Word inner(int count, int b) {
  Word bits = 0;
  for (int i = 0; i < kBlockSide; ++i)
    if (kBlockSide * b + i >= 1 && kBlockSide * b + i < count - 1) bits |= Word{1} << i;
  return bits;
}

/// The images by the area of their silhouettes, the least first: these take the most away.
std::vector<std::size_t> by_area(const Projections& projections) {
  std::vector<std::pair<std::size_t, std::size_t>> order;
  for (std::size_t i = 0; i < projections.image_count(); ++i)
    order.emplace_back(count(projections.image(i).silhouette), i);
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> images;
  for (const auto& [area, i] : order) images.push_back(i);
  return images;
}

/// The corners of boxes of two blocks a side that the first of the `images` do not leave out.
std::vector<Block> boxes_near(const VoxelGrid& grid, const Projections& project,
                              std::span<const std::size_t> images) {
  std::vector<Block> boxes;
  const auto number = [](int i) { return static_cast<std::uint16_t>(i); };
  for (int z = 0; kBlockSide * z < grid.nz; z += 2)
    for (int y = 0; kBlockSide * y < grid.ny; y += 2)
      for (int x = 0; kBlockSide * x < grid.nx; x += 2)
        boxes.push_back({number(x), number(y), number(z), 0});
  for (const std::size_t image : images.first(std::min(images.size(), kBoxImages))) {
    const AffineMap map(grid, project, image);
    const CubeImages cubes(project.image(image).silhouette, map.reach(2 * kBlockSide));
    const FixedPoint to_centre = map.step(3.5, 3.5, 3.5);
    std::erase_if(boxes, [&](const Block& b) {
      return cubes.place_of(map(b) + to_centre) == Place::Outside;
    });
  }
  return boxes;
}

/// All blocks of these boxes, with all voxels but those on the outermost layer of the grid.
std::vector<Block> blocks_of(const VoxelGrid& grid, const std::vector<Block>& boxes) {
  std::vector<Block> blocks;
  for (const Block& box : boxes)
    for (int i = 0; i < 8; ++i) {
      const int x = box.x0 + (i & 1), y = box.y0 + (i >> 1 & 1), z = box.z0 + (i >> 2);
      const Word rows = inner(grid.ny, y), layers = inner(grid.nz, z);
      Word lines = 0;  // bit 0 of every row of the block that is in
      for (int r = 0; r < kBlockSide * kBlockSide; ++r)
        lines |= (rows >> (r % kBlockSide) & layers >> (r / kBlockSide) & 1) << (kBlockSide * r);
      const Word voxels = inner(grid.nx, x) * lines;
      if (voxels != 0)
        blocks.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                          static_cast<std::uint16_t>(z), voxels});
    }
  return blocks;
}

void put(VoxelSet& set, const Block& b) {
  for (std::size_t i = 0; i < std::size_t{kBlockSide} * kBlockSide; ++i) {
    const Word four = b.voxels >> (4 * i) & 0xf;
    if (four == 0) continue;
    const std::size_t y = kBlockSide * b.y0 + i % kBlockSide,
                      z = kBlockSide * b.z0 + i / kBlockSide;
    set.row(y + z * set.rows_per_layer())[b.x0 / 16] |= four << (b.x0 % 16 * kBlockSide);
  }
}

}  // namespace

VoxelSet hull_solid(const VoxelGrid& grid, std::span<const StereoImages> views) {
  const Projections project(views);
  const std::vector<std::size_t> images = by_area(project);
  std::vector<Block> blocks = blocks_of(grid, boxes_near(grid, project, images));
  std::vector<Carver> carvers;
  for (const std::size_t image : images) carvers.emplace_back(grid, project, image);

  // First what is cheap, with all silhouettes; voxels only where a cube has survived it.
  std::vector<std::vector<std::uint32_t>> mixed(carvers.size());
  std::vector<std::uint32_t> alive(blocks.size());
  std::iota(alive.begin(), alive.end(), 0u);
  for (std::size_t i = 0; i < carvers.size(); ++i)
    std::erase_if(alive, [&](std::uint32_t b) {
      const Place place = carvers[i].place_of(blocks[b]);
      if (place == Place::Outside) blocks[b].voxels = 0;
      if (place != Place::Mixed) return place == Place::Outside;
      blocks[b].voxels = carvers[i].carve_cubes(blocks[b]);
      mixed[i].push_back(b);
      return blocks[b].voxels == 0;
    });
  for (std::size_t i = 0; i < carvers.size(); ++i)
    for (const std::uint32_t b : mixed[i])
      if (blocks[b].voxels != 0) blocks[b].voxels = carvers[i].carve_voxels(blocks[b]);

  VoxelSet solid(grid);
  for (const std::uint32_t b : alive) put(solid, blocks[b]);
  return solid;
}

}  // namespace marrow
