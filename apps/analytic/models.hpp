// One function for every analytic shape.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <cmath>

#include "bones.hpp"

namespace marrow {

struct Model {
  Shape shape;
  CurveSkeleton truth;
};

/// How fine the mesh is, which the truth does not depend on, and how the body is bent.
struct Detail {
  double scale = 1;  ///< of the number of samples along a line
  int pose = 0;      ///< of bodies of bones: see posed()

  int count(int samples) const { return static_cast<int>(std::ceil(samples * scale)); }
  double size(double cell) const { return cell / scale; }
};

/// Flesh of one surface around the bones, with cells of `cell`.
Model blended_model(const BoneGraph& graph, double cell, const Detail& detail);

/// A closed tube around every bone, with `sides` corners.
Model overlapping_model(const BoneGraph& graph, int sides, const Detail& detail);

// Swept curves.
Model make_capsule(const Detail& detail);
Model make_tapered_capsule(const Detail& detail);
Model make_beads(const Detail& detail);
Model make_s_tube(const Detail& detail);
Model make_helix(const Detail& detail);
Model make_snake(const Detail& detail);
Model make_torus(const Detail& detail);
Model make_trefoil(const Detail& detail);
Model make_rings(const Detail& detail);

// Graphs.
BoneGraph y_bones();
BoneGraph star_bones();
BoneGraph figure_eight_bones();
BoneGraph double_torus_bones();
BoneGraph cube_frame_bones();
BoneGraph buckyball_bones();
BoneGraph vessel_tree_bones();

// Creatures: y is up, x is ahead.
BoneGraph stick_figure_bones();
BoneGraph gingerbread_bones();
BoneGraph hand_bones();
BoneGraph quadruped_bones();
BoneGraph octopus_bones();
BoneGraph plant_bones();
Model make_gingerbread(const Detail& detail);

// Solids that are not made of round limbs only.
Model make_plate(const Detail& detail);
Model make_mug(const Detail& detail);
Model make_bored_block(const Detail& detail);

}  // namespace marrow
