// The surface of a shape made ready for rays and for nearest points, by Embree.
#pragma once

#include <marrow/normalization.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace marrow {

/// A point of the surface, seen from the place that asked.
struct SurfaceHit {
  double distance = 0;
  std::uint32_t triangle = 0;
  Vec3 position;
};

/// The triangles of a shape under a tree of boxes, built once. Many threads may ask it at once.
/// Embree only names the triangles that may answer a question; distances are computed here, in
/// doubles, and among equal ones the lowest triangle answers.
class SurfaceScene {
 public:
  /// What the tree is for: tracing millions of rays, or quick to build for some thousands of
  /// questions. The answers are the same.
  enum class Use { Images, Questions };

  /// Builds the tree, with as many threads as the TBB arena of the caller allows. `shape` must
  /// outlive this. Throws Error: Limit (out of memory), Internal (Embree does not start).
  explicit SurfaceScene(const NormalizedShape& shape, Use use = Use::Images);
  ~SurfaceScene();
  SurfaceScene(const SurfaceScene&) = delete;
  SurfaceScene& operator=(const SurfaceScene&) = delete;

  /// The point of the surface nearest to `p`, if there is one within `reach`. With `counts` only
  /// triangles count for whose nearest point it is true; it may ask the scene itself.
  std::optional<SurfaceHit> nearest(
      const Vec3& p, double reach, const std::function<bool(const SurfaceHit&)>& counts = {}) const;

  /// Where a ray first meets the surface, if within `reach`. `direction` is a unit vector.
  std::optional<SurfaceHit> first_hit(const Vec3& from, const Vec3& direction, double reach) const;

  /// Every place where a ray meets the surface, within `reach`, the nearest first.
  std::vector<SurfaceHit> all_hits(const Vec3& from, const Vec3& direction, double reach) const;

  /// Twice the area of a triangle along its normal.
  Vec3 normal(std::uint32_t triangle) const;

  struct Embree;
  const Embree& embree() const { return *embree_; }

 private:
  const NormalizedShape& shape_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace marrow
