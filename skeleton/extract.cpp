// Livesu, Guggeri, Scateni: "Reconstructing the Curve-Skeletons of 3D Shapes Using the Visual
// Hull", IEEE TVCG 18(11), 2012. Section numbers are the paper's.
#include <marrow/branch_collapsing.hpp>
#include <marrow/cycle_check.hpp>
#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/hull_topology.hpp>
#include <marrow/perceptual_core.hpp>
#include <marrow/region_growing.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/smoothing.hpp>
#include <marrow/stereo_matching.hpp>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

namespace marrow {

namespace {

constexpr int kFirstImage = 256, kFinestImage = 512;  // pixels along a side

void check(const ExtractOptions& o) {
  const auto require = [](bool ok, const char* message) {
    if (!ok) throw Error(ErrorKind::Usage, message);
  };
  require(o.image_resolution == 0 || (o.image_resolution >= 64 && o.image_resolution <= 1024),
          "the image resolution must be 64 to 1024, or 0");
  require(o.grid_resolution >= 16 && o.grid_resolution <= 256,
          "the grid resolution must be 16 to 256");
  require(o.smoothing_passes >= 0, "the number of smoothing passes must not be negative");
  require(o.max_threads >= 0, "the number of threads must not be negative");
}

/// Runs `task(i)` for i in [0, count), each as one TBB task, on at most `threads` threads.
template <class Task>
void for_each_view(std::size_t count, int threads, Task task) {
  std::optional<tbb::global_control> limit;
  if (threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, task, tbb::simple_partitioner{}); });
}

std::vector<StereoImages> draw_views(const NormalizedShape& shape, int resolution, int threads) {
  const auto directions = hemisphere_directions();
  std::vector<StereoImages> views(directions.size());
  for_each_view(directions.size(), threads, [&](std::size_t i) {
    views[i] = draw_stereo_images(shape, stereo_pair(shape, directions[i]), resolution);
  });
  return views;
}

/// The genus of a shape that is one closed manifold; not counted where the graph has no cycle.
std::optional<int> most_cycles(const Shape& shape, const NormalizedShape& normalized_shape,
                               const VoteGraph& graph) {
  if (!normalized_shape.oriented || graph.edges.size() < graph.nodes.size()) return {};
  const ShapeSummary summary = summarize(shape);
  if (summary.components != 1 || !summary.handles) return {};
  return static_cast<int>(*summary.handles);
}

/// The principal axis without the ball in the middle, for a shape of which no edge is left (a rod
/// thinner than what the images show): long for a rod, short for a ball.
VoteGraph middle_line(const NormalizedShape& shape, const Projections& projections, double voxel) {
  const double half = 0.5 * (shape.high.y - shape.low.y);
  const double end = std::max(half - std::max(hull_radius({}, projections), 0.0), voxel);
  return {{{{0, -end, 0}}, {{0, end, 0}}}, {{0, 1}}};
}

}  // namespace

CurveSkeleton extract(const Shape& shape, const ExtractOptions& options) {
  return extract_with_trace(shape, options).skeleton;
}

ExtractTrace extract_with_trace(const Shape& shape, const ExtractOptions& options) {
  check(options);
  const auto stage = [&](std::string_view name, double done) {
    if (options.on_stage) options.on_stage(name, done);
  };
  ExtractTrace t;

  // 4.2, last paragraphs: the shape's own frame.
  stage("normalise", 0);
  t.normalization = normalize(shape);
  const NormalizedShape normalized_shape = apply(t.normalization, shape);

  // 4.1: 21 stereo pairs, each one task; again, and finer, where parts are thinner than a pixel.
  stage("views", 0.05);
  const bool fixed = options.image_resolution > 0;
  t.resolution = {fixed ? options.image_resolution : kFirstImage, options.grid_resolution};
  t.views = draw_views(normalized_shape, t.resolution.image, options.max_threads);
  const Resolution finer = resolution_for(normalized_shape.low, normalized_shape.high, t.views,
                                          t.resolution, fixed ? 0 : kFinestImage);
  if (finer.image > t.resolution.image)
    t.views = draw_views(normalized_shape, finer.image, options.max_threads);
  t.resolution = finer;
  const double pixel = PixelGrid{finer.image}.pixel();

  // 4.2: matching and voting.
  stage("matching", 0.5);
  VoteAccumulator accumulator(
      make_voxel_grid(normalized_shape.low, normalized_shape.high, t.resolution.grid));
  for_each_view(t.views.size(), options.max_threads,
                [&](std::size_t i) { cast_votes(t.views[i], accumulator); });
  t.votes = std::move(accumulator).finish();
  const double voxel = t.votes.grid.size;

  // 4.3: cleaning by the visual hull, and the tree.
  stage("cleaning", 0.55);
  t.cleaned = clean_grid(t.votes, t.views);
  stage("region growing", 0.65);
  t.tree = grow_spanning_tree(t.cleaned, pixel);
  if (t.tree.nodes.empty())
    throw Error(ErrorKind::Empty,
                "no part of the shape can be seen in enough views; give a shape with some volume");

  // 4.4.1: the perceptual core.
  stage("perceptual core", 0.7);
  t.core = extract_perceptual_core(t.tree, voxel);

  // In place of 4.4.3: the topology of the visual hull.
  stage("hull topology", 0.72);
  const VoxelGrid& grid = t.votes.grid;
  t.solid = supported_solid(grid, majority(grid, hull_solid(grid, t.views)), t.cleaned, t.core);
  const VoxelSet thin_set = thin_by_votes(t.cleaned, t.solid, t.core);
  t.thinned = prune_leaves(graph_of(t.cleaned, t.solid, thin_set, pixel), voxel);

  // 4.4.2: branch collapse.
  stage("branch collapse", 0.95);
  t.collapsed = cut_short_cycles(collapse_branches(t.thinned, voxel), voxel);
  t.collapsed = cut_false_cycles(t.collapsed, normalized_shape, voxel);
  if (const auto most = most_cycles(shape, normalized_shape, t.collapsed))
    t.collapsed = cut_surplus_cycles(t.collapsed, *most);
  t.collapsed = prune_leaves(t.collapsed, voxel);

  // 4.4, last paragraph: tips and smoothing. (Recentring on the surface has its place here.)
  stage("smoothing", 0.97);
  t.smoothed = smooth_branches(trim_leaves(t.collapsed, voxel), options.smoothing_passes);
  const Projections projections(t.views);
  VoteGraph with_radii =
      t.smoothed.edges.empty() ? middle_line(normalized_shape, projections, voxel) : t.smoothed;
  for (auto& n : with_radii.nodes)
    n.radius = std::max(hull_radius(n.position, projections), 0.5 * pixel);
  t.skeleton = to_input_units(with_radii, t.normalization);
  stage("done", 1);
  return t;
}

}  // namespace marrow
