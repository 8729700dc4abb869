#include <marrow/nearest_sample.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace marrow {

namespace {

constexpr int kSlabs = 256;  // across the longest axis of the shape
constexpr double kSlab = 2.0 / kSlabs;

int slab_of(double y) {
  return std::clamp(static_cast<int>(std::floor((y + 1) / kSlab)), 0, kSlabs - 1);
}

/// A point and the spacing there.
struct Sample {
  float x, y, z, spacing;
};

/// Of equally near samples the one of the greatest spacing: that of repeated points is 0.
struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  float spacing = 0;

  void add(double squared_distance, float its_spacing) {
    if (squared_distance > squared) return;
    spacing = squared_distance < squared ? its_spacing : std::max(spacing, its_spacing);
    squared = squared_distance;
  }
};

/// The points of a cloud in slabs along y: the nearest one is looked for in the nearest slabs.
class Slabs {
 public:
  explicit Slabs(const NormalizedShape& cloud) : points_(cloud.x.size()) {
    for (const float y : cloud.y) ++start_[static_cast<std::size_t>(slab_of(double{y})) + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    auto next = start_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto slab = static_cast<std::size_t>(slab_of(double{cloud.y[i]}));
      points_[next[slab]++] = {cloud.x[i], cloud.y[i], cloud.z[i], cloud.spacing[i]};
    }
  }

  Nearest nearest_to(const Vec3& place) const {
    const int own = slab_of(place.y);
    Nearest nearest;
    for (int away = 0; away < kSlabs; ++away) {
      // All points of this slab and of those beyond are at least so far.
      const double gap = (away - 1) * kSlab;
      if (away > 1 && gap * gap > nearest.squared) break;
      visit(own - away, place, nearest);
      if (away > 0) visit(own + away, place, nearest);
    }
    return nearest;
  }

 private:
  void visit(int slab, const Vec3& place, Nearest& nearest) const {
    if (slab < 0 || slab >= kSlabs) return;
    const auto s = static_cast<std::size_t>(slab);
    for (std::size_t i = start_[s]; i < start_[s + 1]; ++i) {
      const auto [x, y, z, spacing] = points_[i];
      nearest.add(squared_length(place - Vec3{double{x}, double{y}, double{z}}), spacing);
    }
  }

  std::vector<Sample> points_;
  std::array<std::size_t, kSlabs + 1> start_{};
};

}  // namespace

std::vector<double> nearest_samples(const NormalizedShape& cloud, std::span<const Vec3> places) {
  const Slabs slabs(cloud);
  std::vector<double> distances;
  distances.reserve(places.size());
  for (const Vec3& place : places) distances.push_back(std::sqrt(slabs.nearest_to(place).squared));
  return distances;
}

std::vector<double> sample_depths(const NormalizedShape& cloud, std::span<const Vec3> places) {
  const Slabs slabs(cloud);
  std::vector<double> depths;
  depths.reserve(places.size());
  for (const Vec3& place : places) {
    const Nearest nearest = slabs.nearest_to(place);
    depths.push_back(std::sqrt(nearest.squared) / double{nearest.spacing});
  }
  return depths;
}

}  // namespace marrow
