// What the maps of meshes, clouds and volumes share.
#pragma once

#include <marrow/bounds.hpp>
#include <marrow/surface_map.hpp>

#include "site_growth_detail.hpp"

namespace marrow {

/// Branches, and every node without an edge as one. Throws Error: Empty.
std::vector<Branch> all_branches(const CurveSkeleton& skeleton);

/// A power of two that brings all coordinates near 1.
double common_scale(Bounds shape, const CurveSkeleton& skeleton);

/// The sites that see their places on the lines are settled; sees(foot, site) asks for one. A site
/// with a neighbour of the same branch that goes by what another one close by has seen goes by it
/// too, and is not asked.
template <class Graph, class Sees>
void settle_by_sight(const Graph& graph, const std::vector<Vec3>& feet, const Sees& sees,
                     SitePlaces& sites) {
  constexpr double kClose = 0.25;  // of the line of sight
  constexpr std::uint32_t kNone = ~0U;
  std::vector<std::uint32_t> goes_by(graph.size(), kNone);
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const Vec3& at = graph.position(i);
    const double close = kClose * kClose * squared_length(at - feet[i]);
    graph.for_each_neighbour(i, [&](std::uint32_t j) {
      const bool is_like = goes_by[i] == kNone && goes_by[j] != kNone &&
                           sites.place[j].branch == sites.place[i].branch;
      if (is_like && squared_length(at - graph.position(goes_by[j])) <= close)
        goes_by[i] = goes_by[j];
    });
    if (goes_by[i] == kNone && sees(feet[i], i)) goes_by[i] = i;
    sites.settled[i] = goes_by[i] != kNone;
  }
}

/// Every site of the graph.
template <class Graph, class Sees>
SurfaceMap map_sites(const Graph& graph, const CurveSkeleton& skeleton, double scale,
                     const Sees& sees) {
  SurfaceMap map;
  map.branches = all_branches(skeleton);
  const Lines lines(skeleton, map.branches, scale);
  SitePlaces sites{std::vector<LinePlace>(graph.size()),
                   std::vector<std::uint8_t>(graph.size(), 0)};
  std::vector<Vec3> feet(graph.size());
  std::uint32_t guess = 0;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const Lines::Nearest nearest = lines.nearest(graph.position(i), guess);
    guess = nearest.edge;
    sites.place[i] = nearest.place;
    feet[i] = nearest.foot;
  }
  settle_by_sight(graph, feet, sees, sites);
  map.seen = graph.size() -
             static_cast<std::size_t>(std::count(sites.settled.begin(), sites.settled.end(), 0));
  settle(graph, lines, sites);
  map.places.resize(graph.size());
  for (std::size_t i = 0; i < graph.size(); ++i)
    map.places[i] = {lines.node(sites.place[i]), sites.place[i].branch, 0};
  return map;
}

/// Numbers the parts of the skeleton, and gives every place its own.
void add_parts(SurfaceMap& map, const CurveSkeleton& skeleton);

}  // namespace marrow
