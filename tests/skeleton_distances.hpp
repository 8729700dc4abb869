// How far one skeleton runs from another.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <algorithm>

#include "mesh_checks.hpp"

namespace marrow::test {

struct Distances {
  double mean = 0, most = 0;
};

inline double distance_to(const CurveSkeleton& s, const Vec3& p, double nearest_so_far) {
  double nearest = nearest_so_far;
  for (const auto& [a, b] : s.edges) {
    const auto &pa = s.nodes[a].position, &pb = s.nodes[b].position;
    if (distance(p, pa) - distance(pa, pb) < nearest)
      nearest = std::min(nearest, pa == pb ? distance(p, pa) : distance_to_segment(p, pa, pb));
  }
  return nearest;
}

/// Distances of points along the edges of `from` to the lines of `to`, weighted by length.
inline Distances distances(const CurveSkeleton& from, const CurveSkeleton& to) {
  Distances d;
  double weight = 0;
  for (const auto& [a, b] : from.edges) {
    const auto &pa = from.nodes[a].position, &pb = from.nodes[b].position;
    const double there = distance_to(to, (pa + pb) * 0.5, 1e300);
    d.mean += there * distance(pa, pb);
    weight += distance(pa, pb);
    d.most = std::max(d.most, there);
  }
  d.mean /= weight;
  return d;
}

}  // namespace marrow::test
