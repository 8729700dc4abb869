#include <marrow/capsule_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace marrow {

namespace {

constexpr std::uint32_t kSides = 16;

/// An icosahedron, turned so that its vertices lie in the planes of the axes, divided once.
Shape unit_ball() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Shape ball;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden}) {
      ball.points.push_back(normalized({a, b, 0}));
      ball.points.push_back(normalized({0, a, b}));
      ball.points.push_back(normalized({b, 0, a}));
    }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto id = static_cast<std::uint32_t>(ball.points.size());
    const auto [found, is_new] = middle_of.try_emplace(std::minmax(i, j), id);
    if (is_new) ball.points.push_back(normalized(ball.points[i] + ball.points[j]));
    return found->second;
  };
  const auto are_near = [&](std::uint32_t i, std::uint32_t j) {
    return dot(ball.points[i], ball.points[j]) > 0.4;  // neighbours have 1 / sqrt(5), others less
  };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!are_near(i, j) || !are_near(j, k) || !are_near(i, k)) continue;
        const bool is_outward = dot(ball.points[i], cross(ball.points[j], ball.points[k])) > 0;
        const std::uint32_t a = i, b = is_outward ? j : k, c = is_outward ? k : j;
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triangle& t :
             {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
          ball.triangles.push_back(t);
      }
  return ball;
}

/// Cosines and sines of the sixteenths of a turn.
std::array<std::pair<double, double>, kSides> unit_circle() {
  const double root = std::sqrt(2.0);
  const std::array<double, 5> cosine = {1, std::sqrt(2 + root) / 2, root / 2,
                                        std::sqrt(2 - root) / 2, 0};
  std::array<std::pair<double, double>, kSides> circle;
  for (std::size_t i = 0; i < 4; ++i) {
    const double c = cosine[i], s = cosine[4 - i];
    circle[i] = {c, s};
    circle[i + 4] = {-s, c};
    circle[i + 8] = {-c, -s};
    circle[i + 12] = {s, -c};
  }
  return circle;
}

void add_ball(Shape& mesh, const Shape& ball, const CurveSkeleton::Node& node) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Vec3& p : ball.points) mesh.points.push_back(node.position + p * node.radius);
  for (const Triangle& t : ball.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// Two axes at right angles to `z` and to each other, right-handed with it.
std::pair<Vec3, Vec3> across(const Vec3& z) {
  const double x = std::abs(z.x), y = std::abs(z.y), depth = std::abs(z.z);
  const Vec3 least = x <= y && x <= depth ? Vec3{1, 0, 0}
                     : y <= depth         ? Vec3{0, 1, 0}
                                          : Vec3{0, 0, 1};
  const Vec3 a = normalized(cross(least, z));
  return {a, cross(z, a)};
}

/// The cone that touches both balls, closed by discs.
void add_cone(Shape& mesh, const CurveSkeleton::Node& from, const CurveSkeleton::Node& to) {
  static const auto circle = unit_circle();
  const double length = distance(from.position, to.position);
  const double slope = (from.radius - to.radius) / length;
  if (!(std::abs(slope) < 1)) return;
  const Vec3 z = (to.position - from.position) / length;
  const auto [x, y] = across(z);
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  const double width = std::sqrt(1 - slope * slope);
  for (const auto* end : {&from, &to})
    for (const auto& [c, s] : circle)
      mesh.points.push_back(end->position + (z * slope + (x * c + y * s) * width) * end->radius);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t a = first + i, b = first + (i + 1) % kSides;
    mesh.triangles.push_back({a, b, a + kSides});
    mesh.triangles.push_back({b, b + kSides, a + kSides});
    if (i < 2) continue;
    const std::uint32_t last = first + i - 1;
    mesh.triangles.push_back({first, a, last});
    mesh.triangles.push_back({first + kSides, last + kSides, a + kSides});
  }
}

}  // namespace

Shape capsule_mesh(const CurveSkeleton& skeleton) {
  static const Shape ball = unit_ball();
  Shape mesh;
  for (const auto& node : skeleton.nodes) add_ball(mesh, ball, node);
  for (const auto& [a, b] : skeleton.edges) add_cone(mesh, skeleton.nodes[a], skeleton.nodes[b]);
  return mesh;
}

}  // namespace marrow
