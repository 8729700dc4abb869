// A mesh that its curve-skeleton moves: joints and skin weights.
#pragma once

#include <marrow/surface_map.hpp>

#include <string>
#include <vector>

namespace marrow {

/// The two joints that move a point of a mesh: nodes of the skeleton, neighbours along the branch
/// that the point is mapped to.
struct SkinWeight {
  NodeId first = 0, second = 0;  ///< the same where the point is beside no edge of the first
  double second_share = 0;       ///< from 0 to 1; what is left is the share of the first

  friend bool operator==(const SkinWeight&, const SkinWeight&) = default;
};

/// Of every point of the mesh: the node that it is mapped to and the neighbour towards whose edge
/// it lies, shared by where it lies along that edge. `map` is that of the mesh and the skeleton.
std::vector<SkinWeight> skin_weights(const Shape& mesh, const CurveSkeleton& skeleton,
                                     const SurfaceMap& map);

/// The mesh with a skin as binary glTF 2.0: a joint for every node, parents from the thickest node
/// of every part on, inverse bind matrices, and JOINTS_0 and WEIGHTS_0 at every point. Edges that
/// close a cycle have no place in a tree of joints and are left out. Throws Error: Empty (a mesh
/// without triangles), Unsupported (more than 65,535 nodes, a coordinate that single precision
/// cannot hold).
std::string format_rig_glb(const Shape& mesh, const CurveSkeleton& skeleton, const SurfaceMap& map);

}  // namespace marrow
