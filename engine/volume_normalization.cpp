#include <marrow/bounds.hpp>
#include <marrow/error.hpp>
#include <marrow/normalization.hpp>
#include <marrow/prescale.hpp>

#include <algorithm>
#include <cmath>

#include "principal_frame_detail.hpp"
#include "voxel_moments_detail.hpp"

namespace marrow {

namespace {

/// From the middle of a voxel to its corners.
std::array<Vec3, 8> corners_of(const std::array<Vec3, 3>& steps) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = ((i & 1 ? steps[0] : -steps[0]) + (i & 2 ? steps[1] : -steps[1]) +
                  (i & 4 ? steps[2] : -steps[2])) *
                 0.5;
  return corners;
}

/// Calls `visit(corner)` for the corners of the voxels at the ends of all rows, in world units by
/// `scale`: no foreground lies outside their convex hull.
template <class Visit>
void for_each_corner(const Volume& volume, const std::vector<RowEnds>& rows, double scale,
                     const Visit& visit) {
  const auto corners =
      corners_of({volume.steps[0] * scale, volume.steps[1] * scale, volume.steps[2] * scale});
  for (const RowEnds& r : rows)
    for (const int x : {r.first, r.last}) {
      const Vec3 middle = volume.to_world({double(x), double(r.y), double(r.z)}) * scale;
      for (const Vec3& corner : corners) visit(middle + corner);
    }
}

/// Vectors from voxel to voxel in units of the moments.
std::array<Vec3, 3> half_steps(const Volume& volume, double scale) {
  return {volume.steps[0] * (0.5 * scale), volume.steps[1] * (0.5 * scale),
          volume.steps[2] * (0.5 * scale)};
}

SymmetricMatrix covariance_of(const VoxelMoments& m, const std::array<Vec3, 3>& steps) {
  const auto component = [&](std::size_t i, int c) {
    return c == 0 ? steps[i].x : c == 1 ? steps[i].y : steps[i].z;
  };
  const auto entry = [&](int row, int column) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        sum += component(i, row) * m.second[i][j] * component(j, column);
    return sum;
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

double third_moment(const VoxelMoments& m, const std::array<Vec3, 3>& steps, const Vec3& axis) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        sum += dot(steps[i], axis) * dot(steps[j], axis) * dot(steps[k], axis) * m.third[i][j][k];
  return sum;
}

}  // namespace

Normalization normalize(const Volume& volume) {
  const std::vector<RowEnds> rows = row_ends(volume);
  if (rows.empty()) throw Error(ErrorKind::Empty, "no voxel is foreground; choose another --iso");
  Bounds box;
  for_each_corner(volume, rows, 1, [&](const Vec3& p) { box.add(p); });
  Normalization n;
  n.prescale = prescale_of(box);
  const Vec3 middle = (box.low * n.prescale + box.high * n.prescale) * 0.5;
  const double magnitude = std::max(length(box.low), length(box.high)) * n.prescale;
  if (!(box.diagonal() * n.prescale > 1e-12 * magnitude))
    throw Error(ErrorKind::Empty, "its voxels are too small for their distance from the origin");

  const VoxelMoments moments = moments_of(volume, rows);
  const auto steps = half_steps(volume, 1 / box.diagonal());
  n.axes =
      principal_frame(covariance_of(moments, steps), [&](const std::array<Vec3, 2>& directions) {
        return std::array{third_moment(moments, steps, directions[0]),
                          third_moment(moments, steps, directions[1])};
      });
  Bounds own;
  for_each_corner(volume, rows, n.prescale,
                  [&](const Vec3& p) { own.add(to_frame(n.axes, p - middle)); });
  n.center = middle + from_frame(n.axes, (own.low + own.high) * 0.5);
  double squared_radius = 0;
  for_each_corner(volume, rows, n.prescale, [&](const Vec3& p) {
    squared_radius = std::max(squared_radius, squared_length(p - n.center));
  });
  n.radius = std::sqrt(squared_radius);
  return n;
}

}  // namespace marrow
