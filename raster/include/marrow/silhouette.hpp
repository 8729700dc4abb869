// Silhouettes by exact integer scanline fill, or by rays (section 4.1).
#pragma once

#include <marrow/for_each.hpp>
#include <marrow/image.hpp>
#include <marrow/normalization.hpp>
#include <marrow/surface_scene.hpp>
#include <marrow/view.hpp>

#include <span>
#include <vector>

namespace marrow {

/// The points of a shape on the sub-pixel lattice of an image: pixel centres lie on multiples of
/// subpixels_of(resolution). Coordinates fit 15 bits; both share a word, which SIMD gathers at
/// once.
class SnappedPoints {
 public:
  using Packed = std::uint32_t;  ///< x in the lower half, y in the upper

  explicit SnappedPoints(std::size_t count) : packed_(count) {}

  std::size_t size() const { return packed_.size(); }
  int x(std::size_t i) const { return static_cast<int>(packed_[i] & 0xffff); }
  int y(std::size_t i) const { return static_cast<int>(packed_[i] >> 16); }
  void set(std::size_t i, int x, int y) {
    packed_[i] = static_cast<Packed>(x) | static_cast<Packed>(y) << 16;
  }
  Packed* packed() { return packed_.data(); }
  const Packed* packed() const { return packed_.data(); }

 private:
  std::vector<Packed> packed_;
};

/// Lattice steps to a pixel: the greatest power of two with resolution * steps <= 2^15.
int subpixels_of(int resolution);

/// All points of the shape in the image plane, snapped to the lattice once.
SnappedPoints snap(const NormalizedShape& shape, const ViewPlane& plane, int resolution);

/// Fills every triangle: a pixel is set when its centre lies in a triangle or on its edge, whatever
/// the triangle's orientation. All arithmetic after the snap is exact.
BitImage fill_triangles(const SnappedPoints& points, std::span<const Triangle> triangles,
                        int resolution);

/// The same by rays, in floats: a pixel is set when the line through its centre meets the surface.
/// Pixels on the border of the silhouette may differ from those of fill_triangles(), and from one
/// version of Embree to the next.
BitImage fill_by_rays(const SurfaceScene& surface, const ViewPlane& plane, int resolution);

/// Draws the edges of thin triangles (twice the area under 8 square pixels) where nothing of `mask`
/// lies in the 3x3 pixels around: slivers and limbs thinner than a pixel leave a trace, and nothing
/// grows thicker.
void trace_thin_triangles(BitImage& mask, const SnappedPoints& points,
                          std::span<const Triangle> triangles, int resolution);

/// Fills the enclosed holes of `mask` whose inscribed radius is under `radius` pixels.
void fill_small_holes(BitImage& mask, double radius);

/// The silhouette of `shape`: fill, trace, and for an open shape the small holes (under 0.02 of the
/// side) filled; on a closed shape holes are real. With `scene`, that of the same shape, rays fill.
BitImage draw_silhouette(const NormalizedShape& shape, const ViewPlane& plane, int resolution,
                         const SurfaceScene* scene = nullptr);

/// The same of many images at once, which is faster where a closed shape has large triangles.
std::vector<BitImage> draw_silhouettes(const NormalizedShape& shape,
                                       std::span<const ViewPlane> planes, int resolution,
                                       const SurfaceScene* scene = nullptr,
                                       const ForEach& for_each = for_each_in_turn);

}  // namespace marrow
