#include "voxelise.hpp"

#include <marrow/bounds.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace marrow {
namespace {

__extension__ using Int128 = __int128;

constexpr std::int64_t kVoxel = 1 << 12;  // lattice units

using LatticePoint = std::array<std::int64_t, 3>;

std::int64_t floor_div(Int128 a, Int128 b) {
  const Int128 q = a / b;
  return static_cast<std::int64_t>(a % b != 0 && (a < 0) != (b < 0) ? q - 1 : q);
}

/// The first row of voxel centres at `place` or beyond it.
int first_voxel(std::int64_t place) {
  return static_cast<int>(floor_div(place - kVoxel / 2 + kVoxel - 1, kVoxel));
}

std::int64_t centre_of(int voxel) { return voxel * kVoxel + kVoxel / 2; }

/// Where a line of voxels along x enters or leaves the shape: from voxel `x` on its winding number
/// is greater by `turn`.
struct Crossing {
  int z, y, x, turn;

  friend bool operator<(const Crossing& a, const Crossing& b) {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  }
};

/// A triangle seen along x, counter-clockwise.
class SeenTriangle {
 public:
  SeenTriangle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
      : corner_{a, b, c} {
    area_ = (b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2]);
    if (area_ < 0) std::swap(corner_[1], corner_[2]), area_ = -area_, turn_ = 1;
  }

  void add_crossings(std::vector<Crossing>& crossings) const {
    if (area_ == 0) return;
    const auto [z0, z1] = range(2);
    const auto [y0, y1] = range(1);
    for (int z = z0; z <= z1; ++z)
      for (int y = y0; y <= y1; ++y) {
        Int128 depth = 0;
        if (meets(centre_of(y), centre_of(z), depth))
          crossings.push_back({z, y, first_voxel(floor_div(depth, area_) + 1), turn_});
      }
  }

 private:
  std::pair<int, int> range(std::size_t axis) const {
    const auto [low, high] = std::minmax({corner_[0][axis], corner_[1][axis], corner_[2][axis]});
    return {first_voxel(low), first_voxel(high + 1) - 1};
  }

  /// Whether the line along x through (y, z) meets the triangle, and area * x where it does. Of two
  /// triangles at an edge a line through it meets one.
  bool meets(std::int64_t y, std::int64_t z, Int128& depth) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const LatticePoint &a = corner_[(i + 1) % 3], &b = corner_[(i + 2) % 3];
      const std::int64_t dy = b[1] - a[1], dz = b[2] - a[2];
      const std::int64_t e = dy * (z - a[2]) - dz * (y - a[1]);
      if (e < 0 || (e == 0 && !(dz < 0 || (dz == 0 && dy > 0)))) return false;
      depth += Int128{e} * corner_[i][0];
    }
    return true;
  }

  std::array<LatticePoint, 3> corner_;
  std::int64_t area_ = 0;
  int turn_ = -1;
};

}  // namespace

Volume voxelise(const Shape& shape, int voxels) {
  Bounds box;
  for (const Vec3& p : shape.points) box.add(p);
  const double voxel = box.longest_side() / voxels;
  const Vec3 corner = box.low - Vec3{1, 1, 1} * voxel;
  const auto side = [&](double extent) { return static_cast<int>(std::ceil(extent / voxel)) + 2; };
  const Vec3 extent = box.high - box.low;
  Volume volume(side(extent.x), side(extent.y), side(extent.z));
  volume.origin = corner + Vec3{0.5, 0.5, 0.5} * voxel;
  volume.steps = {Vec3{voxel, 0, 0}, Vec3{0, voxel, 0}, Vec3{0, 0, voxel}};

  std::vector<LatticePoint> points;
  for (const Vec3& p : shape.points) {
    const Vec3 q = (p - corner) * (static_cast<double>(kVoxel) / voxel);
    points.push_back({std::llrint(q.x), std::llrint(q.y), std::llrint(q.z)});
  }
  std::vector<Crossing> crossings;
  for (const auto& [a, b, c] : shape.triangles)
    SeenTriangle(points[a], points[b], points[c]).add_crossings(crossings);
  std::sort(crossings.begin(), crossings.end());
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const Crossing &at = crossings[i], &next = crossings[i + 1];
    winding += at.turn;
    const bool is_same_row = at.z == next.z && at.y == next.y;
    if (!is_same_row) winding = 0;
    for (int x = at.x; winding != 0 && x < next.x; ++x) volume.set(x, at.y, at.z);
  }
  return volume;
}

}  // namespace marrow
