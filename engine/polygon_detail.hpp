// How a polygon is cut: corners on an integer grid, a planar graph of them, a sweep over it.
#pragma once

#include <marrow/shape.hpp>
#include <marrow/vec.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace marrow::polygon_detail {

/// The corner from which a fan is right, if one of the first two is: every triangle of the fan
/// turns the way the polygon turns. The fan has the polygon as its boundary, so it then covers
/// exactly what the polygon winds around. True for all convex polygons, and for all simple quads.
std::optional<std::size_t> fan_apex(std::span<const Vec3> corners);

/// A place in the plane of the polygon. All are whole numbers of at most 2^29, so that the sign of
/// an area is exact in 64 bits.
struct Node {
  std::int64_t x = 0, y = 0;
  std::uint32_t id = 0;  ///< a corner, or corner count + index of an extra point
};

/// An edge from the lower to the higher node. `winding` is how much more often the polygon runs
/// along it forwards than backwards.
struct Edge {
  std::uint32_t from = 0, to = 0;
  int winding = 0;
};

/// Nodes in order of x, then y, no two at one place, each with an edge; edges in order, no two
/// alike.
struct PlaneGraph {
  std::vector<Node> nodes;
  std::vector<Edge> edges;
};

/// Twice the area of a, b, c: positive when they turn left.
inline std::int64_t doubled_area(const Node& a, const Node& b, const Node& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Brings nodes and edges in order and makes one of those that are alike; edges that cancel go, and
/// with them nodes that have no other.
void tidy(PlaneGraph& graph);

/// Splits edges where they cross or touch, once; crossings are rounded to the grid and appended to
/// `points`, the places of all ids in space. `budget` bounds the work and is used up by it; returns
/// false when it does not suffice.
bool split_crossings(PlaneGraph& graph, std::vector<Vec3>& points, std::int64_t& budget);

/// Triangles (of ids) that cover where the winding number is not zero, or nothing when two edges
/// meet anywhere but in a node.
std::optional<std::vector<Triangle>> triangulate(const PlaneGraph& graph);

}  // namespace marrow::polygon_detail
