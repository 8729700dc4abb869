// Creatures and frames as bones with flesh around them.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <memory>
#include <vector>

#include "curve.hpp"
#include "field.hpp"

namespace marrow {

/// A chain of balls between two joints, and the hulls of each two neighbours as its flesh.
struct Bone {
  int from = 0, to = 0;        ///< joints
  std::vector<Ball> line;      ///< starts at joint `from`, ends at joint `to`
  double flatness = 1;         ///< the flesh is thinner by this factor along `flat_axis`, >= 1
  Vec3 flat_axis{0, 0, 1};     ///< more or less across the line, which never runs along it
  double blend = 0;            ///< width of its blend with the bones before it, 0: a sharp crease
  bool is_centre_line = true;  ///< false: flesh only, no part of the skeleton
};

/// The joints hold only places, so that moving them and the lines between bends the body.
struct BoneGraph {
  std::vector<Vec3> joints;
  std::vector<Bone> bones;
};

/// Adds a joint, returns its number.
int add_joint(BoneGraph& graph, const Vec3& place);

/// Adds a bone through `line` from joint `from` to a new joint at its end, returns that joint.
int add_limb(BoneGraph& graph, int from, std::vector<Ball> line, double blend);

/// Adds a bone through `line` between two joints that are there.
void add_bone(BoneGraph& graph, int from, int to, std::vector<Ball> line, double blend);

/// The smooth union of the bones in their order. It holds a copy.
std::shared_ptr<const Field> blended_field(const BoneGraph& graph);

/// The centre lines, cut into pieces of at most `step`; the radius is that of the largest ball
/// around the place in the flesh of any one bone.
CurveSkeleton centre_lines(const BoneGraph& graph, double step);

/// Every bone as a closed tube of its own: parts that overlap at the joints. Round bones only.
Shape overlapping_tubes(const BoneGraph& graph, int sides);

/// Lowest and highest corner of all flesh.
struct Box {
  Vec3 low, high;
};
Box bounds(const BoneGraph& graph);

}  // namespace marrow
