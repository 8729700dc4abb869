// Every crossing of a bundle of parallel lines with a shape, front to back, by Embree.
#pragma once

#include <marrow/normalization.hpp>
#include <marrow/shape.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace marrow {

/// One crossing of a line with the shape.
struct SurfaceHit {
  float depth = 0;            ///< along the line from its start
  std::uint32_t element = 0;  ///< triangle, or point where the shape has no triangles
  float u = 0, v = 0;         ///< place in the triangle
};

inline constexpr int kBundle = 16;   ///< lines traced together
inline constexpr int kMaxHits = 24;  ///< nearest crossings kept of every line

/// The crossings of one bundle, nearest first, equal depths by element.
struct BundleHits {
  std::array<std::array<SurfaceHit, kMaxHits>, kBundle> hits;
  std::array<int, kBundle> counts{};

  std::span<const SurfaceHit> of(int line) const {
    const auto i = static_cast<std::size_t>(line);
    return {hits[i].data(), static_cast<std::size_t>(counts[i])};
  }
};

/// Starts of the lines of a bundle, in the pose.
struct Bundle {
  std::array<float, kBundle> x, y, z;
};

/// A shape made ready for tracing. Many threads may trace at once.
class SurfaceTracer {
 public:
  /// `pose` brings the shape to about unit size in double before anything becomes float: Embree
  /// drops huge coordinates without a word. Points of a shape without triangles become discs of
  /// radius `disc` that face the line. Throws Error: Internal, when Embree fails.
  SurfaceTracer(const Shape& shape, const Normalization& pose, double disc);
  ~SurfaceTracer();
  SurfaceTracer(const SurfaceTracer&) = delete;
  SurfaceTracer& operator=(const SurfaceTracer&) = delete;

  /// All lines run along `direction` (unit, in the pose). Crossings at the same depth, as on an
  /// edge that two triangles share or in doubled triangles, count once.
  void trace(const Bundle& bundle, const Vec3& direction, BundleHits& hits) const;

  /// Unit normal at a hit, turned against `direction`; smooth where the surface is smooth.
  std::array<float, 3> normal_at(const SurfaceHit& hit, const Vec3& direction) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace marrow
