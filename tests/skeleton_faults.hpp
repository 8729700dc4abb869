// What is true of every curve-skeleton.
#pragma once

#include <marrow/extract.hpp>
#include <marrow/normalization.hpp>
#include <marrow/view.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace marrow::test {

/// What is wrong with nodes or edges; empty if nothing.
inline std::string fault_of(const CurveSkeleton& skeleton) {
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    const auto& n = skeleton.nodes[i];
    const Vec3& p = n.position;
    const std::string node = "node " + std::to_string(i);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return node + " is not at a finite place";
    if (!std::isfinite(n.radius) || !(n.radius > 0)) return node + " has no radius";
  }
  for (std::size_t i = 0; i < skeleton.edges.size(); ++i) {
    const auto [a, b] = skeleton.edges[i];
    const std::string edge = "edge " + std::to_string(i);
    if (b >= skeleton.nodes.size()) return edge + " has an end out of range";
    if (a >= b) return edge + " is not from a lower to a higher node";
    if (i > 0 && !(skeleton.edges[i - 1] < skeleton.edges[i]))
      return edge + " is the same as the one before, or out of order";
  }
  return "";
}

/// The same for what extract() gives for `shape` with images of `image` pixels: also an edge, and
/// no node more than three pixels outside the box of a mesh, in its own frame. A pixel's
/// diagonal is what a silhouette may be too large by; no image looks exactly along a side of the
/// box, so that the hull is thicker than that by its slant.
inline std::string fault_of(const CurveSkeleton& skeleton, const Shape& shape, int image) {
  if (skeleton.edges.empty()) return "there is no edge";
  const std::string fault = fault_of(skeleton);
  if (!fault.empty() || shape.is_point_cloud()) return fault;
  const Normalization frame = normalize(shape);
  const NormalizedShape own = apply(frame, shape);
  const double pixel = PixelGrid{image}.pixel();
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    const Vec3 p = frame.to_normalized(skeleton.nodes[i].position);
    const double outside = std::max({own.low.x - p.x, p.x - own.high.x, own.low.y - p.y,
                                     p.y - own.high.y, own.low.z - p.z, p.z - own.high.z});
    if (!(outside <= 3 * pixel))
      return "node " + std::to_string(i) + " is " + std::to_string(outside / pixel) +
             " pixels outside the box of the shape";
  }
  return "";
}

}  // namespace marrow::test
