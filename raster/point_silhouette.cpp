#include <marrow/point_silhouette.hpp>

#include <algorithm>
#include <cmath>

#include "lattice_triangle_detail.hpp"
#include "mask_detail.hpp"

namespace marrow {

namespace {

using Quarters = std::uint16_t;  // of a pixel

constexpr int kQuarters = 4;
constexpr int kMostQuarters = 1 << 14;
constexpr Quarters kNobody = 0;
constexpr double kBeside = 1;  // pixels: the four neighbours

/// Whether pixels at the very radius belong to a disc.
enum class Rim { In, Out };

/// Half the width of every row of a disc about the centre of a pixel.
class Discs {
 public:
  explicit Discs(Rim rim) : rim_(rim) {}

  /// From the middle row outwards.
  const std::vector<int>& rows(Quarters radius) {
    if (radius >= rows_.size()) rows_.resize(radius + std::size_t{1});
    std::vector<int>& rows = rows_[radius];
    if (!rows.empty()) return rows;
    const std::int64_t square = std::int64_t{radius} * radius - (rim_ == Rim::Out ? 1 : 0);
    for (int y = 0; std::int64_t{16} * y * y <= square; ++y)
      rows.push_back(static_cast<int>(
          std::sqrt(static_cast<double>(square - std::int64_t{16} * y * y)) / kQuarters));
    return rows;
  }

 private:
  Rim rim_;
  std::vector<std::vector<int>> rows_;
};

/// Calls visit(y, left, right) for every row of the disc about pixel (x, y) inside the image.
template <class Visit>
void for_rows(const std::vector<int>& rows, int x, int y, int side, Visit visit) {
  const int reach = static_cast<int>(rows.size()) - 1;
  for (int dy = -reach; dy <= reach; ++dy) {
    if (y + dy < 0 || y + dy >= side) continue;
    const int half = rows[static_cast<std::size_t>(std::abs(dy))];
    visit(y + dy, std::max(x - half, 0), std::min(x + half, side - 1));
  }
}

/// At every pixel the radius of the greatest disc about a point in it.
Image<Quarters> greatest_discs(const NormalizedShape& cloud, const SnappedPoints& points,
                               int resolution) {
  const int shift = lattice_shift(resolution);
  const auto scale = static_cast<float>(kQuarters / PixelGrid{resolution}.pixel());
  Image<Quarters> radii(resolution, resolution, kNobody);
  for (std::size_t i = 0; i < cloud.spacing.size(); ++i) {
    const int radius = static_cast<int>(cloud.spacing[i] * scale + 0.5F);
    Quarters& at = radii(nearest_pixel(points.x(i), shift), nearest_pixel(points.y(i), shift));
    at = std::max(at, static_cast<Quarters>(std::clamp(radius, kQuarters, kMostQuarters)));
  }
  return radii;
}

struct Cover {
  BitImage mask;
  Image<Quarters> owner;  ///< the least radius of the discs over a pixel of the mask
};

Cover cover(const Image<Quarters>& radii) {
  const int side = radii.width();
  Cover c{BitImage(side, side), Image<Quarters>(side, side, kMostQuarters)};
  Discs discs(Rim::In);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Quarters radius = radii(x, y);
      if (radius == kNobody) continue;
      for_rows(discs.rows(radius), x, y, side, [&](int row, int left, int right) {
        set_span(c.mask.row(row), left, right);
        Quarters* const owner = c.owner.row(row);
        for (int i = left; i <= right; ++i) owner[i] = std::min(owner[i], radius);
      });
    }
  return c;
}

/// Takes the discs away again from the outside of the mask, but for a pixel: between its samples a
/// surface bulges.
BitImage eroded(const Cover& c) {
  const int side = c.mask.width();
  BitImage mask = c.mask;
  const BitImage border = without(dilate(mask, kBeside), mask);
  Discs discs(Rim::Out);
  const auto owner_at = [&](int x, int y) {
    return mask.contains(x, y) && c.mask(x, y) ? c.owner(x, y) : kNobody;
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (!border(x, y)) continue;
      const int radius = std::max(
          {owner_at(x - 1, y), owner_at(x + 1, y), owner_at(x, y - 1), owner_at(x, y + 1)});
      const int taken = radius - kQuarters;
      if (taken <= 0) continue;
      for_rows(discs.rows(static_cast<Quarters>(taken)), x, y, side,
               [&](int row, int left, int right) { clear_span(mask.row(row), left, right); });
    }
  return mask;
}

/// The pixels that points fall in.
BitImage pixels_of_points(const Image<Quarters>& radii) {
  BitImage pixels(radii.width(), radii.height());
  for (int y = 0; y < radii.height(); ++y)
    for (int x = 0; x < radii.width(); ++x)
      if (radii(x, y) != kNobody) pixels.set(x, y);
  return pixels;
}

}  // namespace

BitImage draw_point_silhouette(const NormalizedShape& cloud, const ViewPlane& plane,
                               int resolution) {
  const Image<Quarters> radii = greatest_discs(cloud, snap(cloud, plane, resolution), resolution);
  // Every point keeps its pixel and those beside it.
  BitImage mask = united(eroded(cover(radii)), dilate(pixels_of_points(radii), kBeside));
  fill_small_holes(mask, kSmallHole * resolution);
  return mask;
}

}  // namespace marrow
