// The surface of a shape made ready for rays, by Embree.
#pragma once

#include <marrow/normalization.hpp>

#include <memory>

namespace marrow {

/// The triangles of a shape under a tree of boxes, built once. Many threads may ask it at once.
class SurfaceScene {
 public:
  /// Builds the tree, with as many threads as the TBB arena of the caller allows. `shape` must
  /// outlive this. Throws Error: Limit (out of memory), Internal (Embree does not start).
  explicit SurfaceScene(const NormalizedShape& shape);
  ~SurfaceScene();
  SurfaceScene(const SurfaceScene&) = delete;
  SurfaceScene& operator=(const SurfaceScene&) = delete;

  struct Embree;
  const Embree& embree() const { return *embree_; }

 private:
  std::unique_ptr<Embree> embree_;
};

}  // namespace marrow
