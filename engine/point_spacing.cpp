#include <marrow/bounds.hpp>
#include <marrow/point_spacing.hpp>
#include <marrow/prescale.hpp>
#include <marrow/shape_check.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "neighbour_distance_detail.hpp"
#include "place_table_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kKept = 95;  // percent of the points whose distances count as they are
constexpr float kLeastSpacing = 0x1p-40F;  // of the longest side; 0 is for points that do not count

/// The first of the points at every place, in their order.
std::vector<std::uint32_t> distinct_points(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> distinct;
  PlaceTable places(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (places.number_at(points[i], i, [&](std::uint32_t k) { return points[k]; }) == i)
      distinct.push_back(i);
  return distinct;
}

/// Maps the box of the points to sides of at most 1 about the origin.
class UnitBox {
 public:
  explicit UnitBox(const std::vector<Vec3>& points) {
    Bounds bounds;
    for (const Vec3& p : points) bounds.add(p);
    prescale_ = prescale_of(bounds);
    bounds.low = bounds.low * prescale_;
    bounds.high = bounds.high * prescale_;
    center_ = bounds.center();
    side_ = bounds.longest_side();
    if (side_ == 0) side_ = 1;
  }

  PointF to_unit(const Vec3& p) const {
    const Vec3 q = (p * prescale_ - center_) / side_;
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
  }
  double length_to_input(float length) const {
    return std::max(static_cast<double>(length) * side_ / prescale_,
                    std::numeric_limits<double>::denorm_min());
  }

 private:
  double prescale_ = 1, side_ = 1;
  Vec3 center_;
};

float percentile(std::vector<float> values, std::size_t percent) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * percent / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::vector<double> point_spacing(const Shape& shape) {
  if (!shape.is_point_cloud() || shape.points.empty()) return {};
  check_shape(shape);
  const std::vector<std::uint32_t> distinct = distinct_points(shape.points);
  const UnitBox box(shape.points);
  std::vector<PointF> unit;
  unit.reserve(distinct.size());
  for (const std::uint32_t i : distinct) unit.push_back(box.to_unit(shape.points[i]));
  const std::vector<float> distances = neighbour_distances(unit);
  const float most = percentile(distances, kKept);
  std::vector<double> spacing(shape.points.size(), 0);
  for (std::size_t i = 0; i < distinct.size(); ++i)
    spacing[distinct[i]] =
        box.length_to_input(std::clamp(distances[i], kLeastSpacing, std::max(most, kLeastSpacing)));
  return spacing;
}

}  // namespace marrow
