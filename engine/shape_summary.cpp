#include <marrow/shape_summary.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace marrow {

namespace {

using PlaceId = std::uint32_t;

std::vector<bool> used_points(const Shape& shape) {
  std::vector<bool> used(shape.points.size(), shape.triangles.empty());
  for (const Triangle& t : shape.triangles)
    for (const auto p : t) used[p] = true;
  return used;
}

/// For every point the place it stands at; places are numbered in the order of their coordinates.
std::vector<PlaceId> weld(const std::vector<Vec3>& points) {
  const auto key = [&](std::uint32_t i) {
    return std::tuple(points[i].x, points[i].y, points[i].z);
  };
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<PlaceId> place(points.size());
  PlaceId next = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && key(order[i - 1]) != key(order[i])) ++next;
    place[order[i]] = next;
  }
  return place;
}

/// Triangles between places, without those that are flat.
std::vector<Triangle> welded_triangles(const Shape& shape) {
  const std::vector<PlaceId> place = weld(shape.points);
  std::vector<Triangle> result;
  result.reserve(shape.triangles.size());
  for (const Triangle& t : shape.triangles) {
    const Triangle w{place[t[0]], place[t[1]], place[t[2]]};
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) result.push_back(w);
  }
  return result;
}

class Parts {
 public:
  explicit Parts(std::size_t places) : parent_(places) {
    std::iota(parent_.begin(), parent_.end(), PlaceId{0});
  }
  void join(PlaceId a, PlaceId b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  PlaceId root(PlaceId p) {
    while (parent_[p] != p) p = parent_[p] = parent_[parent_[p]];
    return p;
  }

 private:
  std::vector<PlaceId> parent_;
};

struct Places {
  std::size_t used = 0, components = 0;
};

Places count_places(const std::vector<Triangle>& triangles, std::size_t points) {
  Parts parts(points);
  std::vector<bool> used(points, false);
  for (const Triangle& t : triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
    for (const auto p : t) used[p] = true;
  }
  Places count;
  for (PlaceId p = 0; p < points; ++p) {
    count.used += used[p];
    count.components += used[p] && parts.root(p) == p;
  }
  return count;
}

struct Edges {
  std::size_t all = 0, open = 0, crowded = 0;
};

Edges count_edges(const std::vector<Triangle>& triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      edges.push_back(std::uint64_t{low} << 32 | high);
    }
  std::sort(edges.begin(), edges.end());
  Edges count;
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::upper_bound(begin, edges.end(), *begin);
    ++count.all;
    count.open += end - begin == 1;
    count.crowded += end - begin > 2;
    begin = end;
  }
  return count;
}

/// From Euler's formula; nothing where a pinched or one-sided surface makes it meaningless.
std::optional<std::size_t> handles_of(const Places& places, const Edges& edges,
                                      std::size_t triangles) {
  const auto euler = static_cast<std::int64_t>(places.used) + static_cast<std::int64_t>(triangles) -
                     static_cast<std::int64_t>(edges.all);
  const std::int64_t twice = 2 * static_cast<std::int64_t>(places.components) - euler;
  if (edges.open + edges.crowded > 0 || triangles == 0 || twice < 0 || twice % 2 != 0) return {};
  return static_cast<std::size_t>(twice / 2);
}

Bounds bounds_of(const Shape& shape, const std::vector<bool>& used) {
  Bounds bounds;
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    if (used[i]) bounds.add(shape.points[i]);
  return bounds;
}

}  // namespace

ShapeSummary summarize(const Shape& shape) {
  ShapeSummary summary;
  summary.points = shape.points.size();
  summary.triangles = shape.triangles.size();
  const std::vector<bool> used = used_points(shape);
  summary.unused_points = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  summary.bounds = bounds_of(shape, used);
  if (shape.triangles.empty()) return summary;

  const std::vector<Triangle> triangles = welded_triangles(shape);
  const Places places = count_places(triangles, shape.points.size());
  const Edges edges = count_edges(triangles);
  summary.flat_triangles = shape.triangles.size() - triangles.size();
  summary.components = places.components;
  summary.open_edges = edges.open;
  summary.crowded_edges = edges.crowded;
  summary.handles = handles_of(places, edges, triangles.size());
  return summary;
}

}  // namespace marrow
