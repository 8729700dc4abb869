// Bars between joints.
#include <algorithm>
#include <cstdint>

#include "dice.hpp"
#include "models.hpp"
#include "trig.hpp"

namespace marrow {
namespace {

struct Bars {
  std::vector<Vec3> joints;
  std::vector<std::array<int, 2>> pairs;
};

BoneGraph straight_bones(const Bars& bars, double radius, double blend) {
  BoneGraph graph;
  graph.joints = bars.joints;
  for (const auto& [a, b] : bars.pairs) {
    const auto place = [&](int i) { return graph.joints[static_cast<std::size_t>(i)]; };
    add_bone(graph, a, b, {{place(a), radius}, {place(b), radius}}, blend);
  }
  return graph;
}

/// All pairs no further apart than `reach`.
std::vector<std::array<int, 2>> near_pairs(const std::vector<Vec3>& joints, double reach) {
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (std::size_t j = i + 1; j < joints.size(); ++j) {
      if (distance(joints[i], joints[j]) > reach) continue;
      pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  }
  return pairs;
}

struct Sprout {
  int joint;
  Vec3 direction;  ///< unit
  Vec3 side;       ///< unit, across: its children part in the plane of both
  double length, radius;
};

/// Grows a bent vessel, then two thinner ones from its end, `levels` times in all.
void grow(BoneGraph& graph, const Sprout& sprout, int levels, Dice& dice) {
  const Vec3 start = graph.joints[static_cast<std::size_t>(sprout.joint)];
  const Vec3 up = cross(sprout.direction, sprout.side);
  const double sideways = dice.between(-1, 1);  // one roll a line: operands have no order
  const double upward = dice.between(-1, 1);
  const Vec3 bulge = (sprout.side * sideways + up * upward) * (sprout.length * 0.08);
  const double end_radius = sprout.radius * 0.85;
  const Vec3 middle = start + sprout.direction * (sprout.length / 2) + bulge;
  const Vec3 end = start + sprout.direction * sprout.length;
  const int tip = add_limb(
      graph, sprout.joint,
      spline(
          {{start, sprout.radius}, {middle, (sprout.radius + end_radius) / 2}, {end, end_radius}},
          6),
      0.05);
  if (levels == 1) return;
  for (const double sign : {-1.0, 1.0}) {
    const SinCos turn = sin_cos_of_turns(sign * dice.between(0.085, 0.115));
    const SinCos roll = sin_cos_of_turns(dice.between(0.2, 0.3));
    const Vec3 direction = sprout.direction * turn.cos + sprout.side * turn.sin;
    const Vec3 across = normalized(sprout.side * turn.cos - sprout.direction * turn.sin);
    const Vec3 side = across * roll.cos + cross(direction, across) * roll.sin;
    const double next_length = sprout.length * dice.between(0.7, 0.82);
    grow(graph, {tip, normalized(direction), side, next_length, end_radius * 0.8}, levels - 1,
         dice);
  }
}

}  // namespace

BoneGraph y_bones() {
  BoneGraph graph;
  const int middle = add_joint(graph, {});
  add_limb(graph, middle, {{{}, 0.24}, {{0, -1.7, 0}, 0.24}}, 0.12);
  add_limb(graph, middle, {{{}, 0.22}, {{1.15, 1.1, 0.2}, 0.18}}, 0.12);
  add_limb(graph, middle, {{{}, 0.22}, {{-1.0, 1.25, -0.2}, 0.18}}, 0.12);
  return graph;
}

BoneGraph star_bones() {
  BoneGraph graph;
  const int middle = add_joint(graph, {});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.5, -1.5}) {
      const Vec3 tip{axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
      add_limb(graph, middle, {{{}, 0.2}, {tip, 0.15}}, 0.12);
    }
  }
  return graph;
}

BoneGraph figure_eight_bones() {
  BoneGraph graph;
  const int middle = add_joint(graph, {});
  for (const double side : {1.0, -1.0}) {  // the two loops of Gerono's lemniscate
    const Curve loop = sample_curve(97, false, [side](double t) {
      const SinCos at = sin_cos_of_turns(t / 2);
      return Ball{{side * 1.9 * at.sin, 1.7 * at.sin * at.cos, 0}, 0.2};
    });
    add_bone(graph, middle, middle, loop.balls, 0.06);
  }
  return graph;
}

BoneGraph double_torus_bones() {
  BoneGraph graph;
  for (const double side : {1.0, -1.0}) {
    const int joint = add_joint(graph, {side * 0.45, 0, 0});
    const Curve ring = sample_curve(97, false, [side](double t) {
      const SinCos at = sin_cos_of_turns(t);
      return Ball{{side * (1.45 - at.cos), 0.85 * at.sin, side * 0.5 * at.sin}, 0.22};
    });
    add_bone(graph, joint, joint, ring.balls, 0.08);
  }
  add_bone(graph, 0, 1, {{graph.joints[0], 0.22}, {graph.joints[1], 0.22}}, 0.08);
  return graph;
}

BoneGraph cube_frame_bones() {
  Bars bars;
  for (int i = 0; i < 8; ++i) {
    const auto side = [i](int axis) { return (i >> axis & 1) == 1 ? 1.0 : -1.0; };
    bars.joints.push_back({side(0), side(1), side(2)});
  }
  bars.pairs = near_pairs(bars.joints, 2.1);
  return straight_bones(bars, 0.14, 0.06);
}

BoneGraph buckyball_bones() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vec3, 3> kinds{Vec3{0, 1, 3 * golden}, Vec3{1, 2 + golden, 2 * golden},
                                  Vec3{golden, 2, 2 * golden + 1}};
  Bars bars;
  for (const Vec3& kind : kinds) {  // even permutations with all signs, edges of length 2
    for (int signs = 0; signs < 8; ++signs) {
      if (kind.x == 0 && (signs & 1) == 1) continue;
      const Vec3 p{(signs & 1) == 1 ? -kind.x : kind.x, (signs & 2) == 2 ? -kind.y : kind.y,
                   (signs & 4) == 4 ? -kind.z : kind.z};
      for (const Vec3& turned : {p, Vec3{p.y, p.z, p.x}, Vec3{p.z, p.x, p.y}}) {
        bars.joints.push_back(turned * 0.25);
      }
    }
  }
  bars.pairs = near_pairs(bars.joints, 0.51);
  return straight_bones(bars, 0.065, 0.03);
}

BoneGraph vessel_tree_bones() {
  BoneGraph graph;
  Dice dice;
  const int root = add_joint(graph, {});
  grow(graph, {root, {0, 1, 0}, {1, 0, 0}, 1.5, 0.2}, 4, dice);
  return graph;
}

}  // namespace marrow
