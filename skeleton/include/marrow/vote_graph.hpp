// The graph that the stages from ORG to smoothing work on, in the normalised frame.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/vote_grid.hpp>

#include <vector>

namespace marrow {

/// The support of a vote that all images support. It is counted in 42nds of the images, rounded
/// down, so that what is asked of it means the same however many there are.
inline constexpr int kImages = 42;

/// Voxels and the edges between them.
struct VoteGraph {
  struct Node {
    Vec3 position;          ///< normalised frame
    double radius = 0;      ///< of the ball that the matches promise, normalised frame
    int support = 0;        ///< of 42: the share of the images whose medial axis passes here
    int broad_support = 0;  ///< the same, with a tolerance that grows with the radius
    std::uint32_t voxel = 0;

    friend bool operator==(const Node&, const Node&) = default;
  };

  std::vector<Node> nodes;
  std::vector<CurveSkeleton::Edge> edges;  ///< lower id first

  friend bool operator==(const VoteGraph&, const VoteGraph&) = default;
};

/// The same nodes and edges, with the radii of the matches.
CurveSkeleton skeleton_of(const VoteGraph& graph);

}  // namespace marrow
