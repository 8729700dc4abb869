// Creatures of smooth limbs.
#include <utility>

#include "flat_mesh.hpp"
#include "models.hpp"
#include "trig.hpp"

namespace marrow {
namespace {

std::vector<Ball> mirrored(std::vector<Ball> line) {
  for (Ball& ball : line) ball.centre.z = -ball.centre.z;
  return line;
}

/// A limb through `line`, and its mirror image on the other side.
void add_pair(BoneGraph& graph, int from, const std::vector<Ball>& line, double blend) {
  add_limb(graph, from, spline(line, 6), blend);
  add_limb(graph, from, spline(mirrored(line), 6), blend);
}

void flatten_last(BoneGraph& graph, int bones, double flatness, const Vec3& axis) {
  const std::size_t count = graph.bones.size();
  for (std::size_t i = count - static_cast<std::size_t>(bones); i < count; ++i) {
    Bone& bone = graph.bones[i];
    bone.flatness = flatness;
    bone.flat_axis = normalized(axis);
  }
}

}  // namespace

BoneGraph stick_figure_bones() {
  BoneGraph graph;
  constexpr double kBlend = 0.08;
  const Vec3 hip{0, 0, 0};
  const Vec3 chest{0, 1.25, 0};
  const int hips = add_joint(graph, hip);
  const int shoulders = add_limb(graph, hips, {{hip, 0.27}, {chest, 0.27}}, kBlend);
  const Vec3 neck{0, 1.8, 0};
  add_limb(graph, shoulders, {{chest, 0.14}, {neck, 0.13}, {{0, 2.2, 0}, 0.3}}, kBlend);
  add_limb(graph, shoulders, {{chest, 0.15}, {{0.95, 1.0, 0.1}, 0.13}, {{1.75, 1.45, 0.35}, 0.1}},
           kBlend);
  add_limb(graph, shoulders, {{chest, 0.15}, {{-0.9, 0.85, 0}, 0.13}, {{-1.35, 0.05, 0.3}, 0.1}},
           kBlend);
  add_limb(graph, hips, {{hip, 0.2}, {{0.42, -1.15, 0.15}, 0.17}, {{0.5, -2.3, -0.1}, 0.13}},
           kBlend);
  add_limb(graph, hips, {{hip, 0.2}, {{-0.45, -1.1, 0.25}, 0.17}, {{-0.75, -2.2, -0.15}, 0.13}},
           kBlend);
  return graph;
}

BoneGraph gingerbread_bones() {
  BoneGraph graph;
  constexpr double kBlend = 0.3;
  const Vec3 hip{0, -0.35, 0};
  const Vec3 chest{0, 0.55, 0};
  const int hips = add_joint(graph, hip);
  const int shoulders = add_limb(graph, hips, {{hip, 0.5}, {chest, 0.5}}, kBlend);
  add_limb(graph, shoulders, {{chest, 0.3}, {{0, 1.55, 0}, 0.6}}, kBlend);
  for (const double side : {1.0, -1.0}) {
    add_limb(graph, shoulders, {{chest, 0.3}, {{side * 1.5, 0.75, 0}, 0.28}}, kBlend);
    add_limb(graph, hips, {{hip, 0.33}, {{side * 0.85, -1.75, 0}, 0.33}}, kBlend);
  }
  return graph;
}

BoneGraph hand_bones() {
  BoneGraph graph;
  constexpr double kBlend = 0.12;
  const Vec3 palm{0, 0.05, 0};
  const int middle = add_joint(graph, palm);
  add_limb(graph, middle, spline({{palm, 0.46}, {{0, -0.6, 0}, 0.36}, {{0, -1.1, 0}, 0.34}}, 6), 0);
  flatten_last(graph, 1, 1.4, {0, 0, 1});
  struct Finger {
    double knuckle_x, knuckle_y, spread, length, radius, curl;
  };
  const Finger fingers[] = {{-0.48, 0.72, -0.30, 1.2, 0.15, 0.20},
                            {-0.15, 0.85, -0.10, 1.4, 0.16, 0.14},
                            {0.19, 0.8, 0.12, 1.3, 0.155, 0.17},
                            {0.5, 0.62, 0.36, 0.95, 0.13, 0.26}};
  for (const Finger& f : fingers) {
    const Vec3 knuckle{f.knuckle_x, f.knuckle_y, 0.03};
    const Vec3 bend = knuckle + Vec3{f.spread * 0.5, 0.5, -0.03} * f.length;
    const Vec3 tip = knuckle + Vec3{f.spread, 0.95, f.curl} * f.length;
    add_limb(graph, middle,
             spline({{palm, 0.3},
                     {knuckle, f.radius * 1.4},
                     {bend, f.radius * 1.02},
                     {tip, f.radius * 0.8}},
                    8),
             kBlend);
  }
  add_limb(graph, middle,
           spline({{palm, 0.3},
                   {{-0.5, -0.1, 0.12}, 0.27},
                   {{-0.98, 0.3, 0.3}, 0.18},
                   {{-1.2, 0.75, 0.38}, 0.14}},
                  8),
           kBlend);
  // The flesh between the knuckles and along the outer edge of the palm.
  add_bone(graph, middle, middle,
           {{{-0.4, 0.55, 0}, 0.26},
            {{0.05, 0.62, 0}, 0.28},
            {{0.42, 0.45, 0}, 0.26},
            {{0.2, -0.3, 0}, 0.28}},
           kBlend);
  flatten_last(graph, 1, 1.2, {0, 0, 1});
  graph.bones.back().is_centre_line = false;
  return graph;
}

BoneGraph quadruped_bones() {
  BoneGraph graph;
  const Ball hip{{-0.74, 1.12, 0}, 0.27};
  const Ball chest{{0.55, 1.1, 0}, 0.36};
  const int hips = add_joint(graph, hip.centre);
  const int shoulders = add_limb(
      graph, hips, spline({hip, {{-0.32, 1.17, 0}, 0.245}, {{0.12, 1.11, 0}, 0.325}, chest}, 8), 0);
  flatten_last(graph, 1, 1.25, {0, 0, 1});
  const Ball head{{1.22, 1.84, 0}, 0.24};
  const int skull = add_limb(
      graph, shoulders,
      spline({{chest.centre, 0.28}, {{0.84, 1.37, 0}, 0.25}, {{1.06, 1.66, 0}, 0.2}, head}, 6),
      0.14);
  add_limb(graph, skull,
           spline({head,
                   {{1.4, 1.79, 0}, 0.19},
                   {{1.58, 1.71, 0}, 0.105},
                   {{1.72, 1.68, 0}, 0.085},
                   {{1.87, 1.665, 0}, 0.062}},
                  6),
           0.08);
  add_pair(graph, skull,
           {{head.centre, 0.1},
            {{1.14, 2.04, 0.15}, 0.13},
            {{1.09, 2.24, 0.22}, 0.085},
            {{1.06, 2.4, 0.26}, 0.05}},
           0.06);
  flatten_last(graph, 2, 2.0, {1, 0, 0.3});
  graph.bones.back().flat_axis.z = -graph.bones.back().flat_axis.z;
  // Walking: one front leg and the hind leg across from it reach ahead.
  for (const double side : {1.0, -1.0}) {
    const double z = side * 0.18;
    const double step = side * 0.2;
    const double lift = side > 0 ? 0.06 : 0;
    add_limb(graph, shoulders,
             spline({{chest.centre, 0.22},
                     {{0.6 + 0.1 * step, 0.92, z * 0.9}, 0.19},
                     {{0.5 + 0.4 * step, 0.62, z}, 0.105},
                     {{0.57 + step, 0.36 + lift, z}, 0.07},
                     {{0.56 + 1.2 * step, 0.12 + lift, z}, 0.062},
                     {{0.63 + 1.2 * step, 0.06 + lift, z}, 0.066},
                     {{0.73 + 1.2 * step, 0.055 + lift, z}, 0.062}},
                    6),
             0.1);
    add_limb(graph, hips,
             spline({{hip.centre, 0.2},
                     {{-0.7 - 0.1 * step, 0.94, z * 0.9}, 0.22},
                     {{-0.57 - 0.5 * step, 0.66, z}, 0.145},
                     {{-0.83 - step, 0.4, z}, 0.07},
                     {{-0.79 - 1.2 * step, 0.12, z}, 0.06},
                     {{-0.71 - 1.2 * step, 0.06, z}, 0.066},
                     {{-0.6 - 1.2 * step, 0.055, z}, 0.062}},
                    6),
             0.1);
  }
  add_limb(graph, hips,
           spline({{hip.centre, 0.16},
                   {{-1.04, 1.2, 0}, 0.1},
                   {{-1.38, 1.1, 0.02}, 0.15},
                   {{-1.76, 0.9, 0.06}, 0.2},
                   {{-2.12, 0.84, 0.1}, 0.15},
                   {{-2.42, 0.95, 0.12}, 0.035}},
                  8),
           0.1);
  return graph;
}

BoneGraph octopus_bones() {
  BoneGraph graph;
  const Vec3 neck{0, 0.75, 0};
  const int middle = add_joint(graph, neck);
  add_limb(
      graph, middle,
      spline(
          {{neck, 0.36}, {{-0.08, 1.2, 0}, 0.42}, {{-0.45, 1.85, 0}, 0.6}, {{-0.85, 2.3, 0}, 0.42}},
          8),
      0);
  for (int arm = 0; arm < 8; ++arm) {
    // From under the head out along the ground; the end curls up and to one side.
    const double turn = (arm + 0.5) / 8;
    const double wave = arm % 2 == 0 ? 1 : -1;
    const double reach = 1 + 0.06 * ((arm * 5) % 8 - 3.5) / 3.5;
    const SinCos heading = sin_cos_of_turns(turn);
    const Vec3 out{heading.cos, 0, heading.sin};
    const Vec3 side{-heading.sin * wave, 0, heading.cos * wave};
    const auto at = [&](double ahead, double up, double aside, double radius) {
      return Ball{out * (ahead * reach) + side * aside + Vec3{0, up, 0}, radius};
    };
    add_limb(graph, middle,
             spline({{neck, 0.2},
                     at(0.42, 0.42, 0, 0.19),
                     at(0.95, 0.2, 0.05, 0.165),
                     at(1.55, 0.16, -0.1, 0.14),
                     at(2.15, 0.2, 0.02, 0.12),
                     at(2.6, 0.38, 0.28, 0.1),
                     at(2.72, 0.68, 0.56, 0.083),
                     at(2.5, 0.9, 0.72, 0.068),
                     at(2.24, 0.86, 0.7, 0.056),
                     at(2.14, 0.68, 0.6, 0.05)},
                    8),
             0.09);
  }
  return graph;
}

BoneGraph plant_bones() {
  BoneGraph graph;
  const auto stem_at = [](double t) {
    return Ball{{0.22 * sin_cos_of_turns(0.6 * t).sin, 3 * t, 0.12 * sin_cos_of_turns(0.4 * t).sin},
                0.11 - 0.06 * t};
  };
  constexpr int kLeaves = 7;
  const auto height = [](int i) { return i > kLeaves ? 1.0 : i == 0 ? 0.0 : 0.12 + 0.11 * i; };
  int joint = add_joint(graph, stem_at(0).centre);
  for (int i = 0; i <= kLeaves; ++i) {
    const double low = height(i);
    const double high = height(i + 1);
    const auto piece =
        sample_curve(13, false, [&](double t) { return stem_at(low + (high - low) * t); });
    const int next = add_limb(graph, joint, piece.balls, 0);
    if (i > 0) {
      const double size = 1.1 - 0.07 * i;
      const SinCos heading = sin_cos_of_turns(0.381966 * i);  // the golden angle
      const Vec3 out{heading.cos, 0, heading.sin};
      const Vec3 base = stem_at(low).centre;
      const auto at = [&](double ahead, double up, double radius) {
        return Ball{base + (out * ahead + Vec3{0, up, 0}) * size, radius * size};
      };
      const Ball blade = at(0.32, 0.22, 0.05);
      const int stalk = add_limb(graph, joint, spline({at(0, 0, 0.05), blade}, 4), 0.03);
      add_limb(graph, stalk,
               spline({at(0.32, 0.22, 0.11), at(0.7, 0.42, 0.25), at(1.1, 0.52, 0.25),
                       at(1.45, 0.5, 0.11)},
                      8),
               0.03);
      flatten_last(graph, 1, 3.0, Vec3{-0.35 * out.x, 1, -0.35 * out.z});
    }
    joint = next;
  }
  return graph;
}

Model make_gingerbread(const Detail& detail) {
  const BoneGraph graph = gingerbread_bones();
  return {fill_flat(*blended_field(graph), bounds(graph), detail.size(0.05)),
          centre_lines(graph, 0.05)};
}

}  // namespace marrow
