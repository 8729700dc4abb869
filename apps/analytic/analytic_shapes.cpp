#include "analytic_shapes.hpp"

#include <marrow/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "models.hpp"
#include "polygonise.hpp"
#include "pose.hpp"

namespace marrow {
namespace {

constexpr double kTruthStep = 0.05;
constexpr double kStepsPerUnit = 1e6;

using Maker = Model (*)(const Detail&);

/// `Bones` with smooth flesh, in cells of `CellPerMille` / 1000.
template <BoneGraph (*Bones)(), int CellPerMille>
Model make_blend(const Detail& detail) {
  return blended_model(posed(Bones(), detail.pose), CellPerMille / 1000.0, detail);
}

template <BoneGraph (*Bones)(), int Sides>
Model make_overlap(const Detail& detail) {
  return overlapping_model(posed(Bones(), detail.pose), Sides, detail);
}

constexpr auto kClosed = SurfaceKind::Closed;
constexpr auto kOverlapping = SurfaceKind::Overlapping;

// Name, note, surface, components, cycles, leaves.
constexpr auto kInfos = std::to_array<AnalyticShapeInfo>({
    {"capsule", "a straight round rod", kClosed, 1, 0, 2},
    {"tapered-capsule", "a straight rod, thick at one end", kClosed, 1, 0, 2},
    {"beads", "a straight rod that swells six times", kClosed, 1, 0, 2},
    {"s-tube", "a bent rod of changing thickness", kClosed, 1, 0, 2},
    {"helix", "a spring of three turns", kClosed, 1, 0, 2},
    {"snake", "a long thin spiral with a raised head", kClosed, 1, 0, 2},
    {"torus", "a ring", kClosed, 1, 1, 0},
    {"trefoil", "a knotted ring", kClosed, 1, 1, 0},
    {"rings", "a chain of three rings that do not touch", kClosed, 3, 3, 0},
    {"y", "three arms in one joint", kClosed, 1, 0, 3},
    {"y-union", "the same as three overlapping rods", kOverlapping, 1, 0, 3},
    {"star", "six arms along the axes", kClosed, 1, 0, 6},
    {"star-union", "the same as six overlapping rods", kOverlapping, 1, 0, 6},
    {"figure-eight", "two loops through one joint", kClosed, 1, 2, 0},
    {"double-torus", "two rings and a bar between them", kClosed, 1, 2, 0},
    {"cube-frame", "the twelve edges of a cube", kClosed, 1, 5, 0},
    {"buckyball", "the ninety edges of a football", kClosed, 1, 31, 0},
    {"plate", "a flat plate with three round holes", kClosed, 1, 3, 0},
    {"mug", "a cup with a handle; only the cycle of the handle is sure", kClosed, 1, 1, {}},
    {"bored-block",
     "a block with a bore along 1 1 1, which no default view sees through",
     kClosed,
     1,
     1,
     {}},
    {"vessel-tree", "a blood vessel that forks three times", kClosed, 1, 0, 9},
    {"vessel-tree-union", "the same as fifteen overlapping tubes", kOverlapping, 1, 0, 9},
    {"stick-figure", "a person of round limbs", kClosed, 1, 0, 5},
    {"stick-figure-union", "the same as overlapping tubes", kOverlapping, 1, 0, 5},
    {"gingerbread-man", "a person cut out of a sheet without thickness", SurfaceKind::Flat, 1, 0,
     5},
    {"hand", "a palm, five fingers and a wrist", kClosed, 1, 0, 6},
    {"quadruped", "a fox: body, neck, head, ears, four legs and a tail", kClosed, 1, 0, 8},
    {"octopus", "a body and eight curled arms", kClosed, 1, 0, 9},
    {"plant", "a stem with seven thin leaves", kClosed, 1, 0, 9},
});

constexpr std::array<Maker, kInfos.size()> kMakers{
    make_capsule,
    make_tapered_capsule,
    make_beads,
    make_s_tube,
    make_helix,
    make_snake,
    make_torus,
    make_trefoil,
    make_rings,
    make_blend<y_bones, 40>,
    make_overlap<y_bones, 32>,
    make_blend<star_bones, 40>,
    make_overlap<star_bones, 32>,
    make_blend<figure_eight_bones, 40>,
    make_blend<double_torus_bones, 40>,
    make_blend<cube_frame_bones, 38>,
    make_blend<buckyball_bones, 24>,
    make_plate,
    make_mug,
    make_bored_block,
    make_blend<vessel_tree_bones, 24>,
    make_overlap<vessel_tree_bones, 24>,
    make_blend<stick_figure_bones, 40>,
    make_overlap<stick_figure_bones, 32>,
    make_gingerbread,
    make_blend<hand_bones, 34>,
    make_blend<quadruped_bones, 21>,
    make_blend<octopus_bones, 27>,
    make_blend<plant_bones, 20>,
};

/// The plus zero turns -0 into 0.
double rounded(double x) { return std::floor(x * kStepsPerUnit + 0.5) / kStepsPerUnit + 0.0; }

Vec3 rounded(const Vec3& p) { return {rounded(p.x), rounded(p.y), rounded(p.z)}; }

std::string unknown_name(const std::string& name) {
  std::string message = "make: no shape is called '" + name + "'; take one of";
  for (const AnalyticShapeInfo& info : kInfos) message += std::string(" ") + info.name;
  return message;
}

/// Bodies of bones without a loop.
bool can_be_posed(const AnalyticShapeInfo& info) {
  constexpr std::array kBodies{
      "y",           "y-union",           "star",         "star-union",
      "vessel-tree", "vessel-tree-union", "stick-figure", "stick-figure-union",
      "hand",        "quadruped",         "octopus",      "plant"};
  return std::find(kBodies.begin(), kBodies.end(), std::string_view(info.name)) != kBodies.end();
}

std::string cannot_be_posed(const std::string& name) {
  std::string message = "make: " + name + " has no limbs to bend; take one of";
  for (const AnalyticShapeInfo& info : kInfos)
    if (can_be_posed(info)) message += std::string(" ") + info.name;
  return message;
}

std::size_t index_of(const std::string& name) {
  for (std::size_t i = 0; i < kInfos.size(); ++i) {
    if (name == kInfos[i].name) return i;
  }
  throw Error(ErrorKind::Usage, unknown_name(name));
}

}  // namespace

Model blended_model(const BoneGraph& graph, double cell, const Detail& detail) {
  return {polygonise(*blended_field(graph), bounds(graph), detail.size(cell)),
          centre_lines(graph, kTruthStep)};
}

Model overlapping_model(const BoneGraph& graph, int sides, const Detail& detail) {
  return {overlapping_tubes(graph, detail.count(sides)), centre_lines(graph, kTruthStep)};
}

std::span<const AnalyticShapeInfo> analytic_shapes() { return kInfos; }

AnalyticShape make_analytic_shape(const std::string& name, const MakeOptions& options) {
  const std::size_t index = index_of(name);
  const bool is_in_range =
      options.resolution >= kLeastResolution && options.resolution <= kMostResolution;
  if (!is_in_range) throw Error(ErrorKind::Usage, "make: the resolution must be from 0.5 to 50");
  if (options.pose < 0 || options.pose > kMostPose)
    throw Error(ErrorKind::Usage, "make: the pose must be from 0 to " + std::to_string(kMostPose));
  if (options.pose > 0 && !can_be_posed(kInfos[index]))
    throw Error(ErrorKind::Usage, cannot_be_posed(name));
  Model model = kMakers[index]({std::sqrt(options.resolution), options.pose});
  for (Vec3& p : model.shape.points) p = rounded(p);
  for (CurveSkeleton::Node& node : model.truth.nodes) {
    node = {rounded(node.position), rounded(node.radius)};
  }
  const AnalyticShapeInfo& info = kInfos[index];
  return {
      info.name,       info.note,   info.surface, std::move(model.shape), std::move(model.truth),
      info.components, info.cycles, info.leaves};
}

}  // namespace marrow
