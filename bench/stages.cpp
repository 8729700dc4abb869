#include "stages.hpp"

#include <marrow/branch_collapsing.hpp>
#include <marrow/cycle_check.hpp>
#include <marrow/homotopic_thinning.hpp>
#include <marrow/hull_topology.hpp>
#include <marrow/perceptual_core.hpp>
#include <marrow/refinement.hpp>
#include <marrow/region_growing.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/sheet_leaves.hpp>
#include <marrow/smoothing.hpp>
#include <marrow/stereo_matching.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <optional>

namespace marrow {

namespace {

template <class Value>
void keep(const Value& value) {
  benchmark::DoNotOptimize(&value);
}

double voxel_of(const Workload& w) { return w.trace.votes.grid.size; }
int image_of(const Workload& w) { return w.trace.resolution.image; }
double pixel_of(const Workload& w) { return PixelGrid{image_of(w)}.pixel(); }

template <class Function>
void for_each_image(const Workload& w, Function function) {
  for (const StereoImages& view : w.trace.views) function(view.front), function(view.side);
}

// 4.1
void run_normalise(const Workload& w) { keep(apply(normalize(w.shape), w.shape)); }

void draw(const Workload& w, const Vec3& direction, int image) {
  keep(draw_stereo_images(w.normalized, stereo_pair(w.normalized, direction), image));
}

/// The side of images that are only drawn to learn that finer ones are needed; 0: there are none.
int first_look_of(const Workload& w) {
  const bool finer = w.options.image_resolution == 0 && image_of(w) > Resolution{}.image;
  return finer ? Resolution{}.image : 0;
}

void run_first_look(const Workload& w) {
  const int first = first_look_of(w);
  if (first == 0) return;
  std::vector<StereoPair> pairs;
  for (const StereoImages& view : w.trace.views) pairs.push_back(view.pair);
  keep(draw_stereo_images(w.normalized, pairs, first));
}

void run_frames(const Workload& w) {
  for (const Vec3& direction : hemisphere_directions()) keep(stereo_pair(w.normalized, direction));
}

void run_silhouettes(const Workload& w) {
  std::vector<ViewPlane> planes;
  for_each_image(w, [&](const ViewImage& image) { planes.push_back(image.plane); });
  keep(draw_silhouettes(w.normalized, planes, image_of(w)));
}

void run_distances(const Workload& w) {
  for_each_image(w, [](const ViewImage& image) { keep(distance_transform(image.silhouette)); });
}

void run_medial_axes(const Workload& w) {
  for_each_image(w, [](const ViewImage& image) { keep(medial_axis(image.distance)); });
}

void run_distances_to_axes(const Workload& w) {
  for_each_image(w, [&](const ViewImage& image) {
    keep(distance_transform(complement(to_image(image.axis, image_of(w)))));
  });
}

// 4.2
void run_matching(const Workload& w) {
  VoteAccumulator accumulator(
      make_voxel_grid(w.normalized.low, w.normalized.high, w.trace.resolution.grid));
  for (const StereoImages& view : w.trace.views) cast_votes(view, accumulator);
  keep(std::move(accumulator).finish());
}

// 4.3
void run_cleaning(const Workload& w) { keep(clean_grid(w.trace.votes, w.trace.views)); }

void run_region_growing(const Workload& w) {
  keep(grow_spanning_tree(w.trace.cleaned, pixel_of(w)));
}

// 4.4
void run_perceptual_core(const Workload& w) {
  keep(extract_perceptual_core(w.trace.tree, voxel_of(w)));
}

void run_hull_solid(const Workload& w) {
  const VoxelGrid& grid = w.trace.votes.grid;
  keep(supported_solid(grid, majority(grid, hull_solid(grid, w.trace.views)), w.trace.cleaned,
                       w.trace.core));
}

void run_hull_thinning(const Workload& w) {
  const ExtractTrace& t = w.trace;
  const auto depth = distance_transform(t.votes.grid, t.solid);
  const VoxelSet thin_set = thin_by_votes(t.cleaned, t.solid, depth, t.core);
  keep(prune_leaves(graph_of(t.cleaned, t.solid, depth, thin_set, pixel_of(w)), voxel_of(w)));
}

VoteGraph collapse(const Workload& w) {
  return cut_short_cycles(collapse_branches(w.trace.thinned, voxel_of(w)), voxel_of(w));
}

void run_branch_collapse(const Workload& w) { keep(collapse(w)); }

void run_cycle_check(const Workload& w) {
  SurfaceSides surface(w.normalized);
  VoteGraph graph = cut_false_cycles(w.unchecked, surface, voxel_of(w));
  if (w.normalized.oriented && graph.edges.size() >= graph.nodes.size()) {
    const ShapeSummary summary = summarize(w.shape);
    if (summary.components == 1 && summary.handles)
      graph = cut_surplus_cycles(graph, static_cast<int>(*summary.handles));
  }
  keep(prune_leaves(graph, voxel_of(w)));
}

VoteGraph trimmed(const Workload& w) {
  return trim_leaves(cut_hooks(w.trace.collapsed, voxel_of(w)), voxel_of(w));
}

void run_smoothing(const Workload& w) {
  keep(smooth_branches(trimmed(w), w.options.smoothing_passes));
}

/// The tree of the surface, where one is needed, is refinement's too: that counts it again.
void run_sheets(const Workload& w) {
  if (w.normalized.is_point_cloud()) return;
  std::optional<SurfaceScene> surface;
  keep(cut_leaves_in_sheets(trimmed(w), Projections(w.trace.views), [&]() -> const SurfaceScene& {
    if (!surface) surface.emplace(w.normalized, SurfaceScene::Use::Questions);
    return *surface;
  }));
}

/// With the tree that the surface is asked by.
void run_refinement(const Workload& w) {
  CurveSkeleton skeleton = skeleton_of(w.trace.smoothed);
  const Projections projections(w.trace.views);
  for (auto& node : skeleton.nodes)
    node.radius = std::max(hull_radius(node.position, projections), 0.5 * pixel_of(w));
  if (!w.normalized.is_point_cloud()) {
    const SurfaceScene surface(w.normalized, SurfaceScene::Use::Questions);
    skeleton = recentre(skeleton, {w.normalized, surface, projections, pixel_of(w)});
  }
  keep(to_input_units(skeleton, w.trace.normalization));
}

constexpr std::array kStages{
    Stage{"normalise", run_normalise},
    Stage{"first-look", run_first_look},
    Stage{"frames", run_frames},
    Stage{"silhouettes", run_silhouettes},
    Stage{"distances", run_distances},
    Stage{"medial-axes", run_medial_axes},
    Stage{"distances-to-axes", run_distances_to_axes},
    Stage{"matching", run_matching},
    Stage{"cleaning", run_cleaning},
    Stage{"region-growing", run_region_growing},
    Stage{"perceptual-core", run_perceptual_core},
    Stage{"hull-solid", run_hull_solid},
    Stage{"hull-thinning", run_hull_thinning},
    Stage{"branch-collapse", run_branch_collapse},
    Stage{"cycle-check", run_cycle_check},
    Stage{"sheets", run_sheets},
    Stage{"smoothing", run_smoothing},
    Stage{"refinement", run_refinement},
};

}  // namespace

Workload prepare(Shape shape, const ExtractOptions& options) {
  Workload w{std::move(shape), options, {}, {}, {}};
  w.trace = extract_with_trace(w.shape, options);
  w.normalized = apply(w.trace.normalization, w.shape);
  w.unchecked = collapse(w);
  return w;
}

std::span<const Stage> stages() { return kStages; }

void draw_view_pair(const Workload& w, std::size_t view) {
  const Vec3& direction = hemisphere_directions()[view];
  if (const int first = first_look_of(w)) draw(w, direction, first);
  draw(w, direction, image_of(w));
}

}  // namespace marrow
