// From sites that see their branch to all that hang together with them.
#pragma once

#include <marrow/disjoint_sets.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

#include "nearest_line_detail.hpp"

namespace marrow {

/// Vertices, points or voxels and their neighbours are a Graph: `size()`, `position(site)`, and
/// `for_each_neighbour(site, visit)`, by which of two neighbours each finds the other.
///
/// What is known of a site: its place, which is only a guess until the site is settled.
struct SitePlaces {
  std::vector<LinePlace> place;
  std::vector<std::uint8_t> settled;
};

/// Every site that hangs together with settled ones takes the branch of that which is nearest along
/// the graph, and on it the node nearest to itself. Other sites stay as they are.
template <class Graph>
void grow(const Graph& graph, const Lines& lines, SitePlaces& sites) {
  using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // distance, site, from
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
  const auto push = [&](std::uint32_t from, double so_far) {
    graph.for_each_neighbour(from, [&](std::uint32_t site) {
      if (sites.settled[site]) return;
      steps.emplace(so_far + distance(graph.position(from), graph.position(site)), site, from);
    });
  };
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (sites.settled[i]) push(i, 0);
  while (!steps.empty()) {
    const auto [so_far, site, from] = steps.top();
    steps.pop();
    if (sites.settled[site]) continue;
    sites.settled[site] = 1;
    sites.place[site] = lines.descend(sites.place[from], graph.position(site));
    push(site, so_far);
  }
}

/// Of the patches of one branch on one piece of the graph the largest stays, of several the one
/// with the first site; the sites of all others are settled no more.
template <class Graph>
void keep_largest_patches(const Graph& graph, SitePlaces& sites) {
  DisjointSets pieces(graph.size()), patches(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    graph.for_each_neighbour(i, [&](std::uint32_t j) {
      if (j <= i) return;
      pieces.join(i, j);
      if (sites.place[i].branch == sites.place[j].branch) patches.join(i, j);
    });
  if (patches.count() == pieces.count()) return;
  std::vector<std::uint32_t> size(graph.size(), 0);
  for (std::uint32_t i = 0; i < graph.size(); ++i) ++size[patches.root(i)];
  struct Patch {
    std::uint32_t piece, branch, size, root;
  };
  std::vector<Patch> all;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (size[i] > 0) all.push_back({pieces.root(i), sites.place[i].branch, size[i], i});
  std::sort(all.begin(), all.end(), [](const Patch& a, const Patch& b) {
    return std::tuple(a.piece, a.branch, b.size, a.root) <
           std::tuple(b.piece, b.branch, a.size, b.root);
  });
  std::vector<std::uint8_t> stays(graph.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i)
    stays[all[i].root] =
        i == 0 || all[i].piece != all[i - 1].piece || all[i].branch != all[i - 1].branch;
  for (std::uint32_t i = 0; i < graph.size(); ++i) sites.settled[i] = stays[patches.root(i)];
}

/// All sites, from those that are settled: pieces of the graph without one keep their guesses, and
/// in the end every branch is one patch on every piece.
template <class Graph>
void settle(const Graph& graph, const Lines& lines, SitePlaces& sites) {
  grow(graph, lines, sites);
  sites.settled.assign(graph.size(), 1);
  keep_largest_patches(graph, sites);
  grow(graph, lines, sites);
}

}  // namespace marrow
