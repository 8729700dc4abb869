// A flat plate, a mug and a bored block: solids whose centre lines come from their sections.
#include <algorithm>

#include "models.hpp"
#include "polygonise.hpp"
#include "trig.hpp"

namespace marrow {
namespace {

// The plate: a stadium with three round holes on its axis.
constexpr double kHoleStep = 1.1;  // between the middles of two holes
constexpr double kHoleRadius = 0.34;
constexpr double kOuterRadius = 0.84;
constexpr double kHalfThickness = 0.12;

double outline_distance(const Vec3& p) {
  const double x = std::clamp(p.x, -kHoleStep, kHoleStep);
  const double outer = std::sqrt((p.x - x) * (p.x - x) + p.y * p.y) - kOuterRadius;
  double inner = outer;
  for (const double hole : {-kHoleStep, 0.0, kHoleStep}) {
    inner = std::max(inner, kHoleRadius - std::sqrt((p.x - hole) * (p.x - hole) + p.y * p.y));
  }
  return inner;
}

/// The outline, pulled to both sides of z = 0, with round rims.
double plate_distance(const Vec3& p) {
  constexpr double kRim = 0.06;
  const double aside = outline_distance(p) + kRim;
  const double above = std::abs(p.z) - kHalfThickness + kRim;
  const double x = std::max(aside, 0.0);
  const double y = std::max(above, 0.0);
  return std::sqrt(x * x + y * y) + std::min(std::max(aside, above), 0.0) - kRim;
}

Ball plate_ball(double x, double y) {
  const double inside = -outline_distance({x, y, 0});
  return {{x, y, 0}, std::min(inside, kHalfThickness)};
}

/// Middle between a straight rim and a hole: a parabola; at the ends, between two circles: a
/// circle.
std::vector<Ball> plate_side(double from, double to, double sign) {
  const double sum = kOuterRadius + kHoleRadius;
  return sample_curve(25, false,
                      [&](double t) {
                        const double x = from + (to - from) * t;
                        return plate_ball(x, sign * (sum * sum - x * x) / (2 * sum));
                      })
      .balls;
}

std::vector<Ball> plate_end(const Vec3& joint, double side) {
  const double sum = kOuterRadius + kHoleRadius;
  std::vector<Ball> line;
  const auto parabola = [&](double t, double sign) {
    const double x = kHoleStep / 2 * (1 - t);
    return plate_ball(side * (kHoleStep - x), sign * (sum * sum - x * x) / (2 * sum));
  };
  for (int i = 0; i < 24; ++i) line.push_back(parabola(i / 24.0, 1));
  for (int i = 0; i <= 48; ++i) {
    const SinCos at = sin_cos_of_turns(i / 96.0);
    line.push_back(plate_ball(side * (kHoleStep + at.sin * sum / 2), at.cos * sum / 2));
  }
  for (int i = 23; i >= 0; --i) line.push_back(parabola(i / 24.0, -1));
  line.front().centre = joint;
  line.back().centre = {joint.x, -joint.y, 0};
  return line;
}

BoneGraph plate_lines() {
  BoneGraph graph;
  const double half = kHoleStep / 2;
  const double y = plate_side(-half, half, 1).front().centre.y;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 joint{side * half, y, 0};
    const int top = add_joint(graph, joint);
    const int bottom = add_joint(graph, {joint.x, -y, 0});
    add_bone(graph, top, bottom, {plate_ball(joint.x, y), plate_ball(joint.x, -y)}, 0);
    add_bone(graph, top, bottom, plate_end(joint, side), 0);
  }
  add_bone(graph, 0, 2, plate_side(-half, half, 1), 0);
  add_bone(graph, 1, 3, plate_side(-half, half, -1), 0);
  return graph;
}

// The mug stands along y, its handle lies in the plane z = 0.
constexpr double kMugRadius = 0.9;  // of the middle of its wall
constexpr double kMugHeight = 1.1;  // half
constexpr double kWall = 0.13;      // half
constexpr double kHandleRadius = 0.15;
const Vec3 kHandleMiddle{kMugRadius + 0.02, 0.05, 0};
constexpr double kHandleReach = 0.6;

double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 span = b - a;
  const double t = std::clamp(dot(p - a, span) / squared_length(span), 0.0, 1.0);
  return distance(p, a + span * t);
}

double mug_distance(const Vec3& p) {
  const double out = std::sqrt(p.x * p.x + p.z * p.z);
  const Vec3 section{out, p.y, 0};
  const Vec3 corner{kMugRadius, -kMugHeight, 0};
  const double wall = segment_distance(section, corner, {kMugRadius, kMugHeight, 0}) - kWall;
  const double floor = segment_distance(section, {0, -kMugHeight, 0}, corner) - kWall;
  const double cup = smooth_min(wall, floor, 0.15);
  const double ring = distance({p.x, p.y, 0}, kHandleMiddle) - kHandleReach;
  const double handle = std::sqrt(ring * ring + p.z * p.z) - kHandleRadius;
  return smooth_min(cup, std::max(handle, kMugRadius - out), 0.1);
}

/// The one cycle: out along the handle, back inside the wall.
BoneGraph mug_lines() {
  BoneGraph graph;
  const double rise = std::sqrt(kHandleReach * kHandleReach -
                                (kMugRadius - kHandleMiddle.x) * (kMugRadius - kHandleMiddle.x));
  const Vec3 top{kMugRadius, kHandleMiddle.y + rise, 0};
  const Vec3 bottom{kMugRadius, kHandleMiddle.y - rise, 0};
  const int joint = add_joint(graph, top);
  const double start = turns_of(rise, kMugRadius - kHandleMiddle.x);
  std::vector<Ball> arc = sample_curve(97, false, [&](double t) {
                            const SinCos at = sin_cos_of_turns(start * (1 - 2 * t));
                            const Vec3 out{at.cos * kHandleReach, at.sin * kHandleReach, 0};
                            return Ball{kHandleMiddle + out, kHandleRadius};
                          }).balls;
  arc.front() = {top, kWall};
  arc.back() = {bottom, kWall};
  const int other = add_limb(graph, joint, arc, 0);
  add_bone(graph, other, joint, {{bottom, kWall}, {top, kWall}}, 0);
  return graph;
}

// The block has its sides along the axes; its bore runs along (1, 1, 1), which is as far from the
// directions of a half sphere of 21 as any.
const Vec3 kBlock{1.1, 0.8, 0.4};  // half
constexpr double kBlockRound = 0.1;
constexpr double kBoreRadius = 0.15;

double block_distance(const Vec3& p) {
  const auto out = [](double c, double half) { return std::abs(c) - half + kBlockRound; };
  const double x = out(p.x, kBlock.x), y = out(p.y, kBlock.y), z = out(p.z, kBlock.z);
  const Vec3 away{std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)};
  return length(away) + std::min(std::max({x, y, z}), 0.0) - kBlockRound;
}

double bore_distance(const Vec3& p) {
  const double along = (p.x + p.y + p.z) / 3;
  return kBoreRadius - length(p - Vec3{along, along, along});
}

/// Once around the bore, half way to the sides.
CurveSkeleton bore_line() {
  constexpr int kNodes = 64;
  CurveSkeleton line;
  for (int i = 0; i < kNodes; ++i) {
    const SinCos at = sin_cos_of_turns(static_cast<double>(i) / kNodes);
    const Vec3 place{0.66 * at.cos, 0.48 * at.sin, 0};
    line.nodes.push_back({place, -std::max(block_distance(place), bore_distance(place))});
    if (i > 0) line.edges.push_back({static_cast<NodeId>(i - 1), static_cast<NodeId>(i)});
  }
  line.edges.insert(line.edges.begin() + 1, {0, kNodes - 1});
  return line;
}

}  // namespace

Model make_bored_block(const Detail& detail) {
  constexpr double kCrease = 0.06;
  const auto field = make_field(
      [](const Vec3& p) { return smooth_max(block_distance(p), bore_distance(p), kCrease); });
  return {polygonise(*field, {-kBlock, kBlock}, detail.size(0.035)), bore_line()};
}

Model make_plate(const Detail& detail) {
  const double x = kHoleStep + kOuterRadius;
  const Box box{{-x, -kOuterRadius, -kHalfThickness}, {x, kOuterRadius, kHalfThickness}};
  return {polygonise(*make_field(plate_distance), box, detail.size(0.035)),
          centre_lines(plate_lines(), 0.05)};
}

Model make_mug(const Detail& detail) {
  const double x = kMugRadius + kWall;
  const double y = kMugHeight + kWall;
  const Box box{{-x, -y, -x}, {kHandleMiddle.x + kHandleReach + kHandleRadius, y, x}};
  return {polygonise(*make_field(mug_distance), box, detail.size(0.045)),
          centre_lines(mug_lines(), 0.05)};
}

}  // namespace marrow
