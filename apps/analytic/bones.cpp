#include "bones.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "round_cone.hpp"
#include "tube.hpp"

namespace marrow {
namespace {

constexpr double kFar = std::numeric_limits<double>::max();

/// The flat axis, turned to stand square on the piece of the bone from `a` to `b`.
Vec3 flat_axis_at(const Bone& bone, const Ball& a, const Ball& b) {
  const Vec3 along = normalized(b.centre - a.centre);
  return normalized(bone.flat_axis - along * dot(along, bone.flat_axis));
}

std::vector<RoundCone> cones_of(const Bone& bone) {
  std::vector<RoundCone> cones;
  for (std::size_t i = 0; i + 1 < bone.line.size(); ++i) {
    const Ball& a = bone.line[i];
    const Ball& b = bone.line[i + 1];
    const Vec3 axis = bone.flatness > 1 ? flat_axis_at(bone, a, b) : bone.flat_axis;
    cones.emplace_back(a, b, bone.flatness, axis);
  }
  return cones;
}

/// The flesh of one bone: cones with a sharp minimum between them.
struct Limb {
  std::vector<const RoundCone*> cones;
  double blend = 0;
};

double value_of(const Limb& limb, const Vec3& p) {
  double lowest = kFar;
  for (const RoundCone* cone : limb.cones) lowest = std::min(lowest, cone->value(p));
  return lowest;
}

FieldSample sample_of(const Limb& limb, const Vec3& p) {
  FieldSample lowest{kFar, {}};
  for (const RoundCone* cone : limb.cones) {
    const FieldSample one = cone->sample(p);
    if (one.value < lowest.value) lowest = one;
  }
  return lowest;
}

FieldRange range_of(const Limb& limb, const Vec3& centre, double radius) {
  FieldRange lowest{kFar, kFar};
  for (const RoundCone* cone : limb.cones) {
    const FieldRange one = cone->range(centre, radius);
    lowest = {std::min(lowest.low, one.low), std::min(lowest.high, one.high)};
  }
  return lowest;
}

double joined(double a, double b, double blend) {
  return blend > 0 ? smooth_min(a, b, blend) : std::min(a, b);
}

class BlendedField : public Field {
 public:
  using Cones = std::vector<std::vector<RoundCone>>;  ///< of every bone

  explicit BlendedField(const BoneGraph& graph) {
    auto cones = std::make_shared<Cones>();
    for (const Bone& bone : graph.bones) cones->push_back(cones_of(bone));
    for (std::size_t i = 0; i < cones->size(); ++i) {
      Limb limb;
      limb.blend = graph.bones[i].blend;
      for (const RoundCone& cone : (*cones)[i]) limb.cones.push_back(&cone);
      limbs_.push_back(std::move(limb));
    }
    cones_ = std::move(cones);
  }

  BlendedField(std::shared_ptr<const Cones> cones, std::vector<Limb> limbs)
      : cones_(std::move(cones)), limbs_(std::move(limbs)) {}

  double value(const Vec3& p) const override {
    double sum = kFar;
    for (const Limb& limb : limbs_) sum = joined(sum, value_of(limb, p), limb.blend);
    return sum;
  }

  FieldSample sample(const Vec3& p) const override {
    FieldSample sum{kFar, {}};
    for (const Limb& limb : limbs_) {
      const FieldSample one = sample_of(limb, p);
      if (limb.blend > 0) {
        sum = smooth_min(sum, one, limb.blend);
      } else if (one.value < sum.value) {
        sum = one;
      }
    }
    return sum;
  }

  /// The union grows with each of its limbs, so that bounds of the limbs add up to bounds of it.
  FieldRange range(const Vec3& centre, double radius) const override {
    FieldRange sum{kFar, kFar};
    for (const Limb& limb : limbs_) {
      const FieldRange one = range_of(limb, centre, radius);
      sum = {joined(sum.low, one.low, limb.blend), joined(sum.high, one.high, limb.blend)};
    }
    return sum;
  }

  /// Cones that are nowhere the lowest of their limb change nothing, nor do limbs that stay above
  /// the lowest one by two blends: what the far ones sum up to is cut off exactly by the next
  /// minimum.
  std::shared_ptr<const Field> near(const Vec3& centre, double radius) const override {
    double reach = kFar;
    double widest_blend = 0;
    for (const Limb& limb : limbs_) {
      reach = std::min(reach, range_of(limb, centre, radius).high);
      widest_blend = std::max(widest_blend, limb.blend);
    }
    reach += 2 * widest_blend;
    std::vector<Limb> kept;
    for (const Limb& limb : limbs_) {
      const double limb_reach = std::min(reach, range_of(limb, centre, radius).high);
      Limb part;
      part.blend = limb.blend;
      for (const RoundCone* cone : limb.cones) {
        if (cone->range(centre, radius).low <= limb_reach) part.cones.push_back(cone);
      }
      if (!part.cones.empty()) kept.push_back(std::move(part));
    }
    return std::make_shared<BlendedField>(cones_, std::move(kept));
  }

 private:
  std::shared_ptr<const Cones> cones_;  ///< what the limbs point to
  std::vector<Limb> limbs_;
};

}  // namespace

int add_joint(BoneGraph& graph, const Vec3& place) {
  graph.joints.push_back(place);
  return static_cast<int>(graph.joints.size()) - 1;
}

int add_limb(BoneGraph& graph, int from, std::vector<Ball> line, double blend) {
  const int to = add_joint(graph, line.back().centre);
  add_bone(graph, from, to, std::move(line), blend);
  return to;
}

void add_bone(BoneGraph& graph, int from, int to, std::vector<Ball> line, double blend) {
  Bone bone;
  bone.from = from;
  bone.to = to;
  bone.line = std::move(line);
  bone.blend = blend;
  graph.bones.push_back(std::move(bone));
}

std::shared_ptr<const Field> blended_field(const BoneGraph& graph) {
  return std::make_shared<BlendedField>(graph);
}

CurveSkeleton centre_lines(const BoneGraph& graph, double step) {
  std::vector<RoundCone> flesh;
  for (const Bone& bone : graph.bones) {
    const std::vector<RoundCone> cones = cones_of(bone);
    flesh.insert(flesh.end(), cones.begin(), cones.end());
  }
  const auto ball_at = [&](const Vec3& p) {
    double largest = 0;
    for (const RoundCone& cone : flesh) largest = std::max(largest, cone.inner_radius(p));
    return CurveSkeleton::Node{p, largest};
  };
  CurveSkeleton lines;
  for (const Vec3& joint : graph.joints) lines.nodes.push_back(ball_at(joint));
  for (const Bone& bone : graph.bones) {
    if (!bone.is_centre_line) continue;
    const std::vector<Ball> line = subdivided(bone.line, step);
    auto last = static_cast<NodeId>(bone.from);
    for (std::size_t i = 1; i < line.size(); ++i) {
      auto here = static_cast<NodeId>(bone.to);
      if (i + 1 < line.size()) {
        here = static_cast<NodeId>(lines.nodes.size());
        lines.nodes.push_back(ball_at(line[i].centre));
      }
      lines.edges.push_back({std::min(last, here), std::max(last, here)});
      last = here;
    }
  }
  std::sort(lines.edges.begin(), lines.edges.end());
  return lines;
}

Shape overlapping_tubes(const BoneGraph& graph, int sides) {
  Shape shape;
  for (const Bone& bone : graph.bones) {
    double widest = 0;
    for (const Ball& ball : bone.line) widest = std::max(widest, ball.radius);
    append(shape, make_tube({subdivided(bone.line, 8 * widest / sides), false}, sides));
  }
  return shape;
}

Box bounds(const BoneGraph& graph) {
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Bone& bone : graph.bones) {
    for (const Ball& ball : bone.line) {
      const Vec3& c = ball.centre;
      const double r = ball.radius + bone.blend;
      box.low = {std::min(box.low.x, c.x - r), std::min(box.low.y, c.y - r),
                 std::min(box.low.z, c.z - r)};
      box.high = {std::max(box.high.x, c.x + r), std::max(box.high.y, c.y + r),
                  std::max(box.high.z, c.z + r)};
    }
  }
  return box;
}

}  // namespace marrow
