// Curve-skeletons of every kind: none, one node, nodes alone, several parts, trees, many cycles.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <algorithm>
#include <cmath>

#include "random.hpp"

namespace marrow::test {

/// The same for the same seed. With `with_sections` some section radii are known.
inline CurveSkeleton random_skeleton(std::uint64_t seed, bool with_sections = false) {
  Random random(seed);
  CurveSkeleton s;
  const std::uint32_t count = seed < 2 ? static_cast<std::uint32_t>(seed) : 1 + random.below(40);
  const double scale = std::ldexp(1.0, static_cast<int>(random.below(60)) - 30);
  for (std::uint32_t i = 0; i < count; ++i) {
    CurveSkeleton::Node node{random.vector() * scale, random.between(0.001, 1) * scale};
    if (random.below(8) == 0) node.radius = scale;  // equals
    if (with_sections && random.below(2) == 0)
      node.section_radius = node.radius * random.between(1, 2);
    s.nodes.push_back(node);
  }
  // From few edges, which leave nodes alone, to more than a tree has.
  const std::uint32_t edges = count < 2 ? 0 : random.below(2 * count);
  for (std::uint32_t i = 0; i < edges; ++i) {
    const NodeId a = random.below(count), b = random.below(count);
    if (a != b) s.edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(s.edges.begin(), s.edges.end());
  s.edges.erase(std::unique(s.edges.begin(), s.edges.end()), s.edges.end());
  return s;
}

}  // namespace marrow::test
