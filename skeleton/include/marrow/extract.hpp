// The whole method: a shape in, its curve-skeleton out.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/normalization.hpp>
#include <marrow/refinement.hpp>
#include <marrow/resolution.hpp>
#include <marrow/stereo_images.hpp>
#include <marrow/visual_hull.hpp>
#include <marrow/vote_graph.hpp>

#include <functional>
#include <string_view>
#include <vector>

namespace marrow {

/// How the silhouettes are filled.
enum class SilhouetteMethod {
  Scanline,  ///< exact integers: the same bytes on any machine
  Embree,    ///< rays in floats: border pixels may differ from one version of Embree to the next
};

/// What makes a graph of the votes.
enum class Rules {
  Marrow,  ///< ranked by support, with the topology of the visual hull, checked by the surface
  Paper,   ///< sections 4.3 and 4.4 read literally, to compare with: raw votes at voxel centres, a
           ///< spanning tree, zones of influence until nothing changes, joints whose balls meet,
           ///< leaves whose balls meet joined to loops; no refinement. False loops and spurs stay.
};

struct ExtractOptions {
  int image_resolution = 0;   ///< pixels along a side of each image, 64 to 1024; 0: 256,
                              ///< or 512 where parts are thinner than a pixel
  int grid_resolution = 128;  ///< voxels along the longest side of the shape, 16 to 256; thin
                              ///< shapes and parts get up to 192
  double closing = 0;  ///< of point clouds: radius in pixels of one closing of all silhouettes, 0
                       ///< to 24; 0: discs that follow the density of the points
  int smoothing_passes = 5;  ///< 0 and up
  int views = 21;  ///< directions to look along, two images each: 21, or 81 for three to four times
                   ///< the work; they turn with the shape
  /// Directions to look along instead, 1 to 1024, in the coordinates of the shape; of any length.
  /// One that is parallel to an earlier one is left out.
  std::vector<Vec3> directions;
  SilhouetteMethod silhouettes = SilhouetteMethod::Scanline;
  Rules rules = Rules::Marrow;
  Refinement refinement = Refinement::Surface;  ///< the paper's rules have none
  int max_threads = 0;  ///< 0: as many as the machine has; the result does not depend on it
  /// Called as each stage begins, with its name and the share of the work before it (0 to 1), on
  /// the calling thread. May throw to stop the work.
  std::function<void(std::string_view stage, double done)> on_stage;
};

/// The curve-skeleton of `shape`, in its units, for every part of its visual hull. The same shape
/// and options give the same bytes on any machine with any number of threads (with Embree's
/// silhouettes, where Embree is the same). There is always an edge: where the method leaves none, a
/// line of two nodes along the principal axis stands for the shape, short for a ball, long for a
/// rod thinner than a pixel. Throws Error: Empty (nothing to skeletonise), Malformed (a point that
/// counts is not finite, or a corner is no point), Usage (an option out of range), with Embree's
/// silhouettes also Limit (out of memory).
CurveSkeleton extract(const Shape& shape, const ExtractOptions& options = {});

/// The same of the foreground of a volume, in world units.
CurveSkeleton extract(const Volume& volume, const ExtractOptions& options = {});

/// All intermediate results, in the order of the paper.
struct ExtractTrace {
  Normalization normalization;
  Resolution resolution;            ///< of the images and the grid
  std::vector<StereoImages> views;  ///< 4.1: silhouettes, distances, medial axes
  VoteGrid votes;                   ///< 4.2
  VoteGrid cleaned;                 ///< 4.3: with support
  VoteGraph tree;                   ///< 4.3: ORG
  VoteGraph core;                   ///< 4.4.1
  VoxelSet solid;                   ///< the visual hull that is thinned; by Marrow's rules
  VoteGraph thinned;                ///< with the topology of the hull, leaves pruned
  VoteGraph collapsed;              ///< 4.4.2: branches collapsed, short cycles cut
  VoteGraph looped;                 ///< 4.4.3 by the paper's rules, which have no solid: leaves
                                    ///< joined to loops
  VoteGraph smoothed;               ///< 4.4: leaves trimmed, branches smoothed
  CurveSkeleton refined;            ///< recentred, radii final; in the normalised frame
  CurveSkeleton skeleton;           ///< the same in the units of the shape
};

/// extract(), keeping everything.
ExtractTrace extract_with_trace(const Shape& shape, const ExtractOptions& options = {});
ExtractTrace extract_with_trace(const Volume& volume, const ExtractOptions& options = {});

/// A graph in the normalised frame as a skeleton in the units of the shape.
CurveSkeleton to_input_units(const VoteGraph& graph, const Normalization& normalization);
/// The same of a skeleton in the normalised frame.
CurveSkeleton to_input_units(const CurveSkeleton& skeleton, const Normalization& normalization);

}  // namespace marrow
