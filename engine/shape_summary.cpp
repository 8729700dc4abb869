#include <marrow/disjoint_sets.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/weld.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "used_points_detail.hpp"

namespace marrow {

namespace {

using PlaceId = std::uint32_t;

/// Triangles between places, without those that are flat.
std::vector<Triangle> welded_triangles(const Shape& shape) {
  const std::vector<PlaceId> place = welded_points(shape.points);
  std::vector<Triangle> result;
  result.reserve(shape.triangles.size());
  for (const Triangle& t : shape.triangles) {
    const Triangle w{place[t[0]], place[t[1]], place[t[2]]};
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) result.push_back(w);
  }
  return result;
}

struct Places {
  std::size_t used = 0, components = 0;
};

Places count_places(const std::vector<Triangle>& triangles, std::size_t points) {
  DisjointSets parts(points);
  std::vector<std::uint8_t> used(points, 0);
  for (const Triangle& t : triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
    for (const auto p : t) used[p] = 1;
  }
  Places count;
  for (PlaceId p = 0; p < points; ++p) {
    count.used += used[p];
    count.components += used[p] != 0 && parts.root(p) == p;
  }
  return count;
}

struct Edges {
  std::size_t all = 0, open = 0, crowded = 0;
};

/// The greater ends of all edges, sorted by the lesser one: those of place p begin at start[p].
struct EdgeEnds {
  std::vector<std::uint32_t> start;
  std::vector<PlaceId> high;

  EdgeEnds(const std::vector<Triangle>& triangles, std::size_t places)
      : start(places + 1, 0), high(3 * triangles.size()) {
    for_edges(triangles, [&](PlaceId low, PlaceId) { ++start[low + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for_edges(triangles, [&](PlaceId low, PlaceId end) { high[next[low]++] = end; });
  }

  template <class Visit>
  static void for_edges(const std::vector<Triangle>& triangles, Visit visit) {
    for (const Triangle& t : triangles)
      for (const auto& [a, b] : {std::pair(t[0], t[1]), {t[1], t[2]}, {t[2], t[0]}})
        visit(std::min(a, b), std::max(a, b));
  }
};

Edges count_edges(const std::vector<Triangle>& triangles, std::size_t places) {
  EdgeEnds ends(triangles, places);
  Edges count;
  for (std::size_t p = 0; p < places; ++p) {
    auto begin = ends.high.begin() + ends.start[p];
    const auto end = ends.high.begin() + ends.start[p + 1];
    std::sort(begin, end);
    while (begin != end) {
      const auto other = std::find_if(begin, end, [&](PlaceId h) { return h != *begin; });
      ++count.all;
      count.open += other - begin == 1;
      count.crowded += other - begin > 2;
      begin = other;
    }
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

}  // namespace

ShapeSummary summarize(const Shape& shape) {
  ShapeSummary summary;
  summary.points = shape.points.size();
  summary.triangles = shape.triangles.size();
  const bool only_points = shape.triangles.empty();
  const auto used =
      only_points ? std::vector<std::uint8_t>(shape.points.size(), 1) : used_points(shape);
  summary.unused_points = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
  for_used_points(shape, used, [&](const Vec3& p) { summary.bounds.add(p); });
  if (only_points) return summary;

  const std::vector<Triangle> triangles = welded_triangles(shape);
  const Places places = count_places(triangles, shape.points.size());
  const Edges edges = count_edges(triangles, shape.points.size());
  summary.flat_triangles = shape.triangles.size() - triangles.size();
  summary.components = places.components;
  summary.open_edges = edges.open;
  summary.crowded_edges = edges.crowded;
  summary.handles = handles_of(places, edges, triangles.size());
  return summary;
}

}  // namespace marrow
