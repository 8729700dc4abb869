#include <marrow/bounds.hpp>
#include <marrow/compare.hpp>
#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>

#include "segment_tree_detail.hpp"

namespace marrow {

namespace {

using skeleton_detail::SegmentTree;

void add_to(Bounds& bounds, const CurveSkeleton& skeleton) {
  for (const auto& node : skeleton.nodes) bounds.add(node.position);
}

/// In units of `scale` around `center`, where no square overflows or vanishes.
CurveSkeleton scaled(CurveSkeleton skeleton, const Vec3& center, double scale) {
  for (auto& node : skeleton.nodes) node.position = (node.position - center) / scale;
  return skeleton;
}

LineDistance operator*(const LineDistance& distance, double scale) {
  return {distance.mean * scale, distance.most * scale};
}

/// Distances in equal pieces along the edges: the mean by the rule of trapezoids.
LineDistance distance_of_lines(const CurveSkeleton& from, const SegmentTree& to, double step) {
  LineDistance result;
  double weight = 0;
  for (const auto& [a, b] : from.edges) {
    const Vec3 &first = from.nodes[a].position, &last = from.nodes[b].position;
    const double length = distance(first, last);
    const double pieces = std::max(1.0, std::ceil(length / step));
    double sum = 0;
    for (double i = 0; i <= pieces; ++i) {
      const double there = to.distance_to(first + (last - first) * (i / pieces));
      sum += i == 0 || i == pieces ? there / 2 : there;
      result.most = std::max(result.most, there);
    }
    result.mean += sum / pieces * length;
    weight += length;
  }
  if (weight > 0) result.mean /= weight;
  return result;
}

LineDistance distance_of(const CurveSkeleton& from, const SegmentTree& to, double step) {
  LineDistance result = distance_of_lines(from, to, step);
  const std::vector<int> degree = degrees(from);
  double sum = 0;
  for (NodeId n = 0; n < degree.size(); ++n) {
    if (degree[n] > 0) continue;
    const double there = to.distance_to(from.nodes[n].position);
    sum += there;
    result.most = std::max(result.most, there);
  }
  if (from.edges.empty()) result.mean = sum / static_cast<double>(degree.size());
  return result;
}

}  // namespace

Comparison compare(const CurveSkeleton& first, const CurveSkeleton& second, double step) {
  if (!(step > 0 && step <= 1))
    throw Error(ErrorKind::Usage, "the step of a comparison is not in (0, 1]");
  if (first.nodes.empty() || second.nodes.empty())
    throw Error(ErrorKind::Empty, "a curve-skeleton without nodes has no distance from another");
  Bounds around_first, around_both;
  add_to(around_first, first);
  add_to(around_both, first);
  add_to(around_both, second);
  const double side = around_both.longest_side(), scale = side > 0 ? side : 1;
  const Vec3 center = around_both.center();
  const CurveSkeleton a = scaled(first, center, scale), b = scaled(second, center, scale);
  const double longest = step * around_both.diagonal() / scale;
  return {distance_of(a, SegmentTree(b), longest) * scale,
          distance_of(b, SegmentTree(a), longest) * scale, around_first.diagonal()};
}

}  // namespace marrow
