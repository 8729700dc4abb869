#include <marrow/error.hpp>
#include <marrow/point_spacing.hpp>
#include <marrow/prescale.hpp>
#include <marrow/shape_check.hpp>
#include <marrow/surface_map.hpp>
#include <marrow/weld.hpp>

#include <cmath>
#include <numeric>

#include "sight_detail.hpp"
#include "surface_map_detail.hpp"

namespace marrow {

namespace {

/// Points and who is beside whom, as one array with offsets.
class PointGraph {
 public:
  /// `for_each_pair(visit)` calls visit(a, b) for every two neighbours, twice the same way.
  template <class Pairs>
  PointGraph(std::span<const Vec3> points, const Pairs& for_each_pair)
      : points_(points), start_(points.size() + 1, 0) {
    for_each_pair([&](std::uint32_t a, std::uint32_t b) { ++start_[a + 1], ++start_[b + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    neighbours_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      neighbours_[next[a]++] = b;
      neighbours_[next[b]++] = a;
    });
  }

  std::size_t size() const { return points_.size(); }
  const Vec3& position(std::uint32_t i) const { return points_[i]; }
  template <class Visit>
  void for_each_neighbour(std::uint32_t i, const Visit& visit) const {
    for (std::size_t n = start_[i]; n < start_[i + 1]; ++n) visit(neighbours_[n]);
  }

 private:
  std::span<const Vec3> points_;
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> neighbours_;
};

struct Scaled {
  double scale = 1;
  std::vector<Vec3> points;
};

Scaled scaled(const Shape& shape, const CurveSkeleton& skeleton) {
  Bounds box;
  for (const Vec3& p : shape.points) box.add(p);
  Scaled result{common_scale(box, skeleton), shape.points};
  for (Vec3& p : result.points) p = p * result.scale;
  return result;
}

SurfaceMap map_mesh(const Shape& shape, const CurveSkeleton& skeleton,
                    const std::vector<std::uint32_t>& weld) {
  const Scaled s = scaled(shape, skeleton);
  std::vector<Triangle> triangles = shape.triangles;
  for (Triangle& t : triangles)
    for (std::uint32_t& corner : t) corner = weld[corner];
  const PointGraph graph(s.points, [&](const auto& visit) {
    for (const auto& [a, b, c] : triangles) visit(a, b), visit(b, c), visit(c, a);
  });
  const SurfaceSight sight(s.points, triangles);
  return map_sites(graph, skeleton, s.scale, [&](const Vec3& foot, std::uint32_t i) {
    return weld[i] == i && sight.is_free(foot, s.points[i]);
  });
}

SurfaceMap map_cloud(const Shape& cloud, const CurveSkeleton& skeleton,
                     const std::vector<std::uint32_t>& weld) {
  const Scaled s = scaled(cloud, skeleton);
  std::vector<double> spacing = point_spacing(cloud);
  for (double& distance : spacing) distance *= s.scale;
  const CloudSight sight(s.points, spacing);
  const PointGraph graph(s.points, [&](const auto& visit) {
    for (std::uint32_t i = 0; i < s.points.size(); ++i)
      if (weld[i] == i) sight.for_each_near(i, [&](std::uint32_t near) { visit(i, near); });
  });
  return map_sites(graph, skeleton, s.scale, [&](const Vec3& foot, std::uint32_t i) {
    return weld[i] == i && sight.is_free(foot, i);
  });
}

}  // namespace

std::vector<Branch> all_branches(const CurveSkeleton& skeleton) {
  if (skeleton.nodes.empty())
    throw Error(ErrorKind::Empty, "the skeleton has no nodes; nothing can be mapped to it");
  for (const auto& n : skeleton.nodes)
    for (const double number : {n.position.x, n.position.y, n.position.z, n.radius})
      if (!std::isfinite(number))
        throw Error(ErrorKind::Malformed,
                    "a node of the skeleton is not finite; give a number for each coordinate");
  std::vector<Branch> all = branches(skeleton);
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) all.push_back({{n}});
  return all;
}

double common_scale(Bounds shape, const CurveSkeleton& skeleton) {
  for (const auto& n : skeleton.nodes) shape.add(n.position);
  return prescale_of(shape);
}

void add_parts(SurfaceMap& map, const CurveSkeleton& skeleton) {
  DisjointSets parts(skeleton.nodes.size());
  for (const auto& e : skeleton.edges) parts.join(e[0], e[1]);
  std::vector<std::uint32_t> number(skeleton.nodes.size(), 0);
  for (NodeId n = 0; n < number.size(); ++n)
    number[n] = parts.root(n) == n ? map.part_count++ : number[parts.root(n)];
  for (SurfaceMap::Place& place : map.places) place.part = number[place.node];
}

SurfaceMap map_surface(const Shape& shape, const CurveSkeleton& skeleton) {
  check_shape(shape);
  const std::vector<std::uint32_t> weld = welded_points(shape.points);
  SurfaceMap map =
      shape.is_point_cloud() ? map_cloud(shape, skeleton, weld) : map_mesh(shape, skeleton, weld);
  for (std::uint32_t i = 0; i < weld.size(); ++i) map.places[i] = map.places[weld[i]];
  add_parts(map, skeleton);
  return map;
}

}  // namespace marrow
