// Where voxels and cubes of voxels fall in an image, and what the silhouette says of them.
#pragma once

#include <marrow/visual_hull.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace marrow {

inline constexpr int kBlockSide = 4;  // voxels: 64 make a word

/// A block of voxels; bit x + 4 y + 16 z is the voxel (4 x0 + x, 4 y0 + y, 4 z0 + z).
struct Block {
  std::uint16_t x0, y0, z0;
  VoxelSet::Word voxels;
};

/// Image coordinates in fixed point, x in the upper half and y in the lower. They add up as one
/// number. Half a pixel is in them, so that the whole part is the nearest pixel.
class FixedPoint {
 public:
  FixedPoint() = default;
  FixedPoint(double x, double y) : packed_((fixed(x) << 32) + fixed(y)) {}
  static FixedPoint nearest(double x, double y) { return {x + kBias + 0.5, y + kBias + 0.5}; }

  FixedPoint operator+(const FixedPoint& p) const {
    FixedPoint sum;
    sum.packed_ = packed_ + p.packed_;
    return sum;
  }

  int x() const { return static_cast<int>(biased_x()) - kBias; }
  int y() const { return static_cast<int>(biased_y()) - kBias; }
  std::uint32_t biased_x() const { return static_cast<std::uint32_t>(packed_ >> (32 + kFraction)); }
  std::uint32_t biased_y() const { return static_cast<std::uint32_t>(packed_) >> kFraction; }
  /// Bits of kTie are set when one coordinate is so near the border of two pixels that the error of
  /// a sum could decide.
  std::uint64_t ties() const { return ((packed_ + both(kError)) & both(kFar)) - both(1); }
  static constexpr std::uint64_t kTie = std::uint64_t{1} << 63 | std::uint64_t{1} << 31;
  static constexpr int kBias = 4096;  // pixels, so that no coordinate is negative

 private:
  static constexpr int kFraction = 18;        // bits behind the point
  static constexpr std::uint32_t kError = 8;  // in last bits; a sum has at most six terms
  static constexpr std::uint32_t kFar = (1u << kFraction) - 2 * kError;

  static constexpr std::uint64_t both(std::uint32_t bits) {
    return std::uint64_t{bits} << 32 | bits;
  }
  static std::uint64_t fixed(double c) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(c * (1 << kFraction)));
  }

  std::uint64_t packed_ = 0;
};

/// Whether a pixel of an image is set, for points that are known to lie in it.
class Lookup {
 public:
  explicit Lookup(const BitImage& image)
      : words_(image.words().data()),
        per_row_(static_cast<std::size_t>(image.words_per_row())),
        bias_(FixedPoint::kBias * per_row_ + FixedPoint::kBias / 64) {}

  std::uint64_t operator()(const FixedPoint& p) const {
    const std::size_t x = p.biased_x();
    return words_[p.biased_y() * per_row_ + x / 64 - bias_] >> (x % 64) & 1;
  }

 private:
  const std::uint64_t* words_;
  std::size_t per_row_, bias_;
};

/// Where the centres of voxels fall in an image.
class AffineMap {
 public:
  AffineMap(const VoxelGrid& grid, const Projections& project, std::size_t image);

  /// The first voxel of a block.
  FixedPoint operator()(const Block& b) const {
    return blocks_[0][b.x0] + blocks_[1][b.y0] + blocks_[2][b.z0];
  }
  /// From there to the point `x`, `y`, `z` voxels on.
  FixedPoint step(double x, double y, double z) const {
    return {du_[0] * x + du_[1] * y + du_[2] * z, dv_[0] * x + dv_[1] * y + dv_[2] * z};
  }
  /// How far the centres of a cube of `side` voxels lie from its own, in pixels, at most.
  std::pair<double, double> reach(int side) const;

 private:
  std::array<double, 3> du_{}, dv_{};  // along x, y and z
  std::array<std::vector<FixedPoint>, 3> blocks_;
};

enum class Place { Outside, Mixed, Inside };

/// What a silhouette says of all cubes of one size.
struct CubeImages {
  int rx = 0, ry = 0;  // pixels that a cube covers on each side of its centre
  BitImage some, all;  // a silhouette pixel is among them; all of them are silhouette

  CubeImages(const BitImage& mask, const std::pair<double, double>& reach);

  Place place_of(const FixedPoint& centre) const {
    const int x = centre.x(), y = centre.y();
    if (!some.contains(x, y)) {
      const bool is_far = x < -rx || y < -ry || x >= some.width() + rx || y >= some.height() + ry;
      return is_far ? Place::Outside : Place::Mixed;
    }
    if (!some(x, y)) return Place::Outside;
    return all(x, y) ? Place::Inside : Place::Mixed;
  }

  /// Whether all that a cube covers lies in the image.
  bool has_whole(const FixedPoint& centre) const {
    const int x = centre.x(), y = centre.y();
    return x >= rx && y >= ry && x < some.width() - rx && y < some.height() - ry;
  }
};

}  // namespace marrow
