#include "pose.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "dice.hpp"
#include "trig.hpp"

namespace marrow {
namespace {

constexpr double kSwing = 0.1, kBend = 0.125;  // turns at most, at a joint and in the middle
constexpr int kTries = 64;                     // before a pose is made with half of the turns
constexpr double kStep = 0.05;                 // between the balls whose gaps are measured

/// A turn about an axis through a place.
struct Turn {
  Vec3 about;
  Frame frame;  ///< where the axes go

  Vec3 operator()(const Vec3& p) const { return about + from_frame(frame, p - about); }
};

/// A direction in the ball, then on the sphere: no trigonometry.
Vec3 any_direction(Dice& dice) {
  while (true) {
    const double x = dice.between(-1, 1);  // one roll a line: operands have no order
    const double y = dice.between(-1, 1);
    const double z = dice.between(-1, 1);
    const double squared = squared_length({x, y, z});
    if (squared > 0.01 && squared < 1) return normalized({x, y, z});
  }
}

Turn any_turn(Dice& dice, const Vec3& about, double most) {
  const Vec3 axis = any_direction(dice);
  const SinCos by = sin_cos_of_turns(dice.between(-most, most));
  const auto turned = [&](const Vec3& e) {
    return e * by.cos + cross(axis, e) * by.sin + axis * (dot(axis, e) * (1 - by.cos));
  };
  return {about, {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}};
}

bool is_limb(const Bone& bone) { return bone.from != bone.to; }

/// Turns a bone from the ball `first` on, and what hangs on its end.
void turn(BoneGraph& body, std::size_t bone_index, std::size_t first, const Turn& by) {
  std::vector<bool> moves(body.joints.size());
  const auto place = [&](int joint) -> Vec3& {
    return body.joints[static_cast<std::size_t>(joint)];
  };
  for (std::size_t i = bone_index; i < body.bones.size(); ++i) {
    Bone& bone = body.bones[i];
    const bool hangs = i != bone_index && moves[static_cast<std::size_t>(bone.from)];
    if (!hangs && i != bone_index) continue;
    for (std::size_t k = hangs ? 0 : first; k < bone.line.size(); ++k)
      bone.line[k].centre = by(bone.line[k].centre);
    bone.flat_axis = from_frame(by.frame, bone.flat_axis);
    if (!is_limb(bone)) continue;
    moves[static_cast<std::size_t>(bone.to)] = true;
    place(bone.to) = by(place(bone.to));
  }
}

void bend(BoneGraph& body, Dice& dice, double share) {
  for (std::size_t i = 0; i < body.bones.size(); ++i) {
    if (!is_limb(body.bones[i])) continue;
    turn(body, i, 1, any_turn(dice, body.bones[i].line.front().centre, kSwing * share));
    const std::size_t middle = body.bones[i].line.size() / 2;
    if (body.bones[i].line.size() > 2)
      turn(body, i, middle + 1, any_turn(dice, body.bones[i].line[middle].centre, kBend * share));
  }
}

/// The joint that two bones share, or -1.
int common_joint(const Bone& a, const Bone& b) {
  for (const int joint : {a.from, a.to})
    if (joint == b.from || joint == b.to) return joint;
  return -1;
}

/// The balls of a bone that are clear of `joint`: where bones meet they overlap.
std::vector<Ball> clear_of(const Bone& bone, const BoneGraph& body, int joint) {
  std::vector<Ball> balls = subdivided(bone.line, kStep);
  if (joint < 0) return balls;
  const Vec3& meeting = body.joints[static_cast<std::size_t>(joint)];
  const double thickest =
      std::max_element(bone.line.begin(), bone.line.end(), [](const Ball& a, const Ball& b) {
        return a.radius < b.radius;
      })->radius;
  std::erase_if(balls,
                [&](const Ball& ball) { return distance(ball.centre, meeting) < 3 * thickest; });
  return balls;
}

/// The least gap between two bones, and the radius of the thinner one there.
struct Gap {
  double width = std::numeric_limits<double>::max();
  double radius = 0;
};

Gap gap_between(const BoneGraph& body, const Bone& a, const Bone& b) {
  const int joint = common_joint(a, b);
  const std::vector<Ball> others = clear_of(b, body, joint);
  Gap least;
  for (const Ball& p : clear_of(a, body, joint))
    for (const Ball& q : others) {
      const double width = distance(p.centre, q.centre) - p.radius - q.radius;
      if (width < least.width) least = {width, std::min(p.radius, q.radius)};
    }
  return least;
}

bool is_clear(const BoneGraph& body, const BoneGraph& at_rest) {
  for (std::size_t i = 0; i < body.bones.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_limb(body.bones[i]) || !is_limb(body.bones[j])) continue;
      const Gap gap = gap_between(body, body.bones[i], body.bones[j]);
      if (gap.width >= gap.radius) continue;
      if (gap.width < gap_between(at_rest, at_rest.bones[i], at_rest.bones[j]).width) return false;
    }
  return true;
}

}  // namespace

BoneGraph posed(const BoneGraph& body, int number) {
  if (number == 0) return body;
  Dice dice(static_cast<std::uint64_t>(number));
  for (double share = 1; share > 1e-3; share /= 2)
    for (int i = 0; i < kTries; ++i) {
      BoneGraph bent = body;
      bend(bent, dice, share);
      if (is_clear(bent, body)) return bent;
    }
  return body;
}

}  // namespace marrow
