// Which place on the lines of a skeleton a point belongs to, as far as distances tell.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "box_tree_detail.hpp"

namespace marrow {

/// A node of a branch, by the number of the branch and the number of the node along it.
struct LinePlace {
  std::uint32_t branch = 0, step = 0;
};

/// The lines of a skeleton as balls swept along its branches.
class Lines {
 public:
  /// Positions and radii are multiplied by `scale`. Every node is on one of `branches`, which must
  /// outlive this.
  Lines(const CurveSkeleton& skeleton, std::span<const Branch> branches, double scale);

  struct Nearest {
    LinePlace place;         ///< the nearer node of the edge
    std::uint32_t edge = 0;  ///< to begin the next search with
    Vec3 foot;               ///< on the edge, as near to the point as can be
    double gap = 0;          ///< from the ball around the foot to the point; negative inside
  };

  /// The place with the least gap; of several, that of the first edge. The answer does not depend
  /// on `guess`, an edge that may be near.
  Nearest nearest(const Vec3& p, std::uint32_t guess) const;

  /// The node at which the distance to `p` is least when one walks along the branch from `place`.
  LinePlace descend(const LinePlace& place, const Vec3& p) const;

  NodeId node(const LinePlace& place) const { return branches_[place.branch].nodes[place.step]; }

 private:
  struct Ball {
    Vec3 middle;
    double radius;
  };
  /// From a node of a branch to the next, or that node alone.
  struct Edge {
    LinePlace place;
    Ball from, to;
    double squared_length;
  };
  struct Foot {
    Vec3 position;
    double along = 0, gap = 0;
  };

  Foot foot_on(const Edge& edge, const Vec3& p) const;

  std::span<const Branch> branches_;
  std::vector<Ball> balls_;  // of the nodes
  std::vector<Edge> edges_;
  std::optional<BoxTree> tree_;  // of the edges' balls
};

}  // namespace marrow
