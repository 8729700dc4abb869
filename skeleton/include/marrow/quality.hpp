// How good a curve-skeleton is for its shape: inside, centred, telling the shape, of its topology.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>
#include <marrow/volume.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace marrow {

/// How far the surface is from the balls of a skeleton: from the union of all balls whose centre
/// and radius go from one end of an edge to the other. In shares of the diagonal.
struct Reconstruction {
  double mean = 0, p95 = 0, most = 0;
  double covered = 0;  ///< share of the surface within the balls or no more than 1 % outside them
};

/// Where the centre line stands in the sections of the shape across it.
struct Centredness {
  double mean = 0;  ///< of |a - b| / (a + b) for opposite distances a, b to the surface; 0 is best
  double p90 = 0;   ///< of the samples' own means
  std::size_t samples = 0;
};

/// What is measured; nothing where it is not defined. Shares are 0 to 1, and lengths are in shares
/// of the diagonal of the shape's box.
struct SkeletonQuality {
  std::optional<int> shape_components;  ///< of a mesh: surfaces that hang together; of a volume:
                                        ///< parts; nothing for open surfaces and clouds
  std::optional<int> shape_cycles;      ///< handles of a closed manifold, or tunnels of a volume
  double length = 0;                    ///< of all lines
  std::optional<double> outside;        ///< share of the length outside the shape
  std::optional<double> outside_most;   ///< how far from the surface it gets there
  std::optional<Centredness> centredness;
  std::optional<Reconstruction> reconstruction;  ///< by the section radii, where there are none by
                                                 ///< the radii of the nodes
  std::optional<Reconstruction> inscribed_reconstruction;  ///< by the distances to the surface
  std::optional<double> radius_error;  ///< mean |radius - distance to the surface| of nodes inside
};

/// What makes `skeleton` no curve-skeleton, the first of it in one line: a number that is not
/// finite, a radius that is not greater than 0, an edge to nowhere, to itself or given twice.
std::optional<std::string> fault_of(const CurveSkeleton& skeleton);

/// Measures `skeleton` against `shape`; the same bytes with any number of threads. Samples are 0.25
/// % of the diagonal apart (outside), 400 along all lines (centredness; without those nearer to a
/// leaf or joint than to the surface) and 20,000 on the surface (reconstruction). A surface that is
/// open encloses what most directions say that it does; where it encloses no sample, and for point
/// clouds, nothing is said of the outside and of centredness. The points of a cloud are its
/// surface. Throws Error: Malformed (the skeleton has a fault, or the shape's points are not
/// finite), Empty (the shape has no extent), Limit (memory).
SkeletonQuality measure_quality(const Shape& shape, const CurveSkeleton& skeleton);

/// The same for the foreground of a volume; its surface is that of its voxels.
SkeletonQuality measure_quality(const Volume& volume, const CurveSkeleton& skeleton);

}  // namespace marrow
