// From the surface to the skeleton: which node, branch and part every point of a shape belongs to.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>
#include <marrow/volume.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marrow {

/// The segmentation of a shape by the branches of its skeleton.
struct SurfaceMap {
  struct Place {
    NodeId node = 0;
    std::uint32_t branch = 0;  ///< one of `branches`; the node is on it
    std::uint32_t part = 0;  ///< connected parts of the skeleton, in the order of their first nodes

    friend bool operator==(const Place&, const Place&) = default;
  };

  /// Of every point of a shape, used or not, or of every foreground voxel of a volume, in their
  /// order (voxels: x runs fastest, then y, then z).
  std::vector<Place> places;
  std::vector<Branch> branches;  ///< branches(skeleton), then every node without an edge as one
  std::uint32_t part_count = 0;
  std::size_t seen = 0;  ///< places that see their branch without leaving the shape
};

/// Maps a mesh or a point cloud. A point that sees the place on the skeleton whose ball it is
/// nearest to, with no triangle in between, belongs to it. All others take the branch of the point
/// nearest along the surface that does: over edges between triangles, where points at the same
/// place are one, or between neighbours in a cloud. So nothing is mapped across a gap because it is
/// nearer in space. On every connected piece of the surface a branch is one connected patch. A
/// piece of which no point sees the skeleton goes by distance. The same input gives the same
/// result everywhere. Throws Error: Empty (a skeleton without nodes), Malformed (see extract()).
SurfaceMap map_surface(const Shape& shape, const CurveSkeleton& skeleton);

/// The same for the foreground of a volume, along voxels that touch.
SurfaceMap map_surface(const Volume& volume, const CurveSkeleton& skeleton);

}  // namespace marrow
