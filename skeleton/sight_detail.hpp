// Whether one can see from a place inside a shape to a point of its surface.
#pragma once

#include <marrow/shape.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "box_tree_detail.hpp"

namespace marrow {

/// The triangles of a surface, which hide what is behind them.
class SurfaceSight {
 public:
  /// Both must outlive this; coordinates near 1.
  SurfaceSight(std::span<const Vec3> points, std::span<const Triangle> triangles);

  /// Whether no triangle lies between `from` and `to`; those that touch `to` do not count.
  bool is_free(const Vec3& from, const Vec3& to) const;

 private:
  std::span<const Vec3> points_;
  std::span<const Triangle> triangles_;
  std::optional<BoxTree> tree_;
};

/// The points of a cloud, each a ball half as wide as its neighbourhood.
class CloudSight {
 public:
  /// `spacing`: point_spacing(). Both must outlive this; coordinates near 1.
  CloudSight(std::span<const Vec3> points, std::span<const double> spacing);

  /// Whether no ball lies between `from` and point `to`; those near the point do not count.
  bool is_free(const Vec3& from, std::uint32_t to) const;

  /// Calls visit(other) for every other point in whose neighbourhood point `p` is.
  template <class Visit>
  void for_each_near(std::uint32_t p, const Visit& visit) const {
    const Vec3& at = points_[p];
    tree_->any(
        [&](const ReachBox& box) { return box.squared_distance(at) <= box.reach * box.reach; },
        [&](std::uint32_t q) {
          const double reach = spacing_[q];
          if (q != p && squared_length(points_[q] - at) <= reach * reach) visit(q);
          return false;
        });
  }

 private:
  std::span<const Vec3> points_;
  std::span<const double> spacing_;
  std::optional<BoxTree> tree_;
};

}  // namespace marrow
