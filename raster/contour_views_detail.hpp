// Where the triangles of an oriented surface turn away from the eye, in many images at once.
#pragma once

#include <marrow/for_each.hpp>

#include "contour_fill_detail.hpp"
#include "faces_in_views_detail.hpp"

namespace marrow {

/// Up to kMostViews images of a shape with edge_neighbours(). An edge is a contour where the
/// triangle on one side of it runs counter-clockwise and that on the other side does not. A pixel
/// centre is in a counter-clockwise triangle or on its edge where the contours run around it, or on
/// a contour: the sum of all borders of these triangles is that of their contours.
class ContourViews {
 public:
  ContourViews(const NormalizedShape& shape, std::span<const Triangle> neighbours,
               std::span<const ViewPlane> planes, int resolution, const ForEach& for_each);

  /// `points` are those of image `view`.
  std::vector<ContourEdge> contours(std::size_t view, const SnappedPoints& points) const;
  /// The triangles without area.
  PackedTriangles flat(std::size_t view, const SnappedPoints& points) const;
  /// The same as fill().
  BitImage fill(std::span<const ContourEdge> contours, const PackedTriangles& flat) const;

  /// Looks which triangles have some of the pixels in the box of theirs.
  void look_for(const SomePixels& pixels, const ForEach& for_each);
  /// Those, and maybe some beside.
  PackedTriangles found(std::size_t view, const SnappedPoints& points) const;
  /// False: found() and flat() have nothing.
  bool may_have_thin(std::size_t view) const;

 private:
  /// What a run of triangles adds to the images.
  struct Block {
    ListsByView contours;  ///< 4 times the triangle, plus the corner that the edge leaves
    ListsByView flat, found;
  };

  PackedTriangles packed(std::size_t view, ListsByView Block::*list,
                         const SnappedPoints& points) const;
  void find_contours(std::size_t block, const std::vector<ViewBits>& front);
  std::size_t first_of(std::size_t block) const;

  const NormalizedShape& shape_;
  std::span<const Triangle> neighbours_;
  int resolution_;
  ViewAxes axes_;
  std::vector<Block> blocks_;
};

}  // namespace marrow
