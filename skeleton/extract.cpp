// Livesu, Guggeri, Scateni: "Reconstructing the Curve-Skeletons of 3D Shapes Using the Visual
// Hull", IEEE TVCG 18(11), 2012. Section numbers are the paper's.
#include <marrow/branch_collapsing.hpp>
#include <marrow/cycle_check.hpp>
#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/gap_bridging.hpp>
#include <marrow/homotopic_thinning.hpp>
#include <marrow/hull_topology.hpp>
#include <marrow/loop_recovery.hpp>
#include <marrow/nearest_sample.hpp>
#include <marrow/perceptual_core.hpp>
#include <marrow/point_spacing.hpp>
#include <marrow/refinement.hpp>
#include <marrow/region_growing.hpp>
#include <marrow/shape_summary.hpp>
#include <marrow/sheet_leaves.hpp>
#include <marrow/smoothing.hpp>
#include <marrow/stereo_matching.hpp>
#include <marrow/touching_bodies.hpp>
#include <marrow/volume_summary.hpp>
#include <marrow/volume_surface.hpp>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "branch_graph_detail.hpp"

namespace marrow {

namespace {

constexpr int kFirstImage = 256, kFinestImage = 512;  // pixels along a side
constexpr std::size_t kMostDirections = 1024;
constexpr double kLongestGap = 5;  // in the sampling of a cloud: spacings

void check(const ExtractOptions& o) {
  const auto require = [](bool ok, const char* message) {
    if (!ok) throw Error(ErrorKind::Usage, message);
  };
  require(o.image_resolution == 0 || (o.image_resolution >= 64 && o.image_resolution <= 1024),
          "the image resolution must be 64 to 1024, or 0");
  require(o.grid_resolution >= 16 && o.grid_resolution <= 256,
          "the grid resolution must be 16 to 256");
  require(o.closing >= 0 && o.closing <= 24, "the closing must be 0 to 24 pixels");
  require(o.smoothing_passes >= 0, "the number of smoothing passes must not be negative");
  require(o.views == 21 || o.views == 81, "the number of views must be 21 or 81");
  require(o.directions.size() <= kMostDirections, "there must be no more than 1024 directions");
  require(o.max_threads >= 0, "the number of threads must not be negative");
}

/// Runs `work()`, which may start TBB tasks, on at most `threads` threads.
template <class Work>
void run_on(int threads, Work work) {
  std::optional<tbb::global_control> limit;
  if (threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(work);
}

/// Runs `task(i)` for i in [0, count), each as one TBB task, on at most `threads` threads.
template <class Task>
void for_each_view(std::size_t count, int threads, Task task) {
  run_on(threads,
         [&] { tbb::parallel_for(std::size_t{0}, count, task, tbb::simple_partitioner{}); });
}

/// Tells of the stages and takes what they give: extract_with_trace() keeps it, extract() does not.
class Recorder {
 public:
  Recorder(const ExtractOptions& options, ExtractTrace* trace) : options_(options), trace_(trace) {}

  void begin(std::string_view stage, double done) const {
    if (options_.on_stage) options_.on_stage(stage, done);
  }
  template <class Result>
  Result keep(Result ExtractTrace::*place, Result result) const {
    if (trace_) trace_->*place = result;
    return result;
  }

 private:
  const ExtractOptions& options_;
  ExtractTrace* trace_;
};

/// The radii of the discs around the points of a cloud; empty for a mesh.
std::vector<double> disc_radii(const Shape& shape, const ExtractOptions& options) {
  std::vector<double> radii = point_spacing(shape);
  if (radii.empty() || options.closing == 0) return radii;
  const auto all_of = [&](double radius) {
    for (double& r : radii)
      if (r > 0) r = radius;
    return radii;
  };
  // Room for these discs makes the image smaller, and its pixels with them.
  const double without_discs =
      normalize(shape, all_of(std::numeric_limits<double>::denorm_min())).length_to_input(1);
  const int image = options.image_resolution > 0 ? options.image_resolution : kFirstImage;
  const double half_image = 1 / PixelGrid{image}.pixel();
  return all_of(without_discs * options.closing / (half_image - options.closing));
}

/// What is drawn, and the frame it is drawn in.
struct Framed {
  Normalization frame;
  NormalizedShape shape;
};

Framed in_own_frame(const Shape& shape, const ExtractOptions& options) {
  const std::vector<double> spacing = disc_radii(shape, options);
  const Normalization frame = normalize(shape, spacing);
  return {frame, apply(frame, shape, spacing)};
}

Framed in_own_frame(const Volume& volume, const ExtractOptions&) {
  const Normalization frame = normalize(volume);
  return {frame, apply(frame, boundary_surface(volume))};
}

/// Where to look from, in the shape's own frame.
std::vector<Vec3> view_directions(const Normalization& frame, const ExtractOptions& options) {
  if (!options.directions.empty()) {
    std::vector<Vec3> directions = distinct_directions(options.directions);
    for (Vec3& d : directions) d = to_frame(frame.axes, d);
    return directions;
  }
  const auto directions =
      options.views == 81 ? fine_hemisphere_directions() : hemisphere_directions();
  return {directions.begin(), directions.end()};
}

struct DrawnViews {
  Resolution resolution;
  std::vector<StereoImages> views;
};

/// All views; drawn again, and finer, where parts are thinner than a pixel.
DrawnViews draw_views(const NormalizedShape& shape, const SurfaceScene* scene,
                      const std::vector<Vec3>& directions, const ExtractOptions& options) {
  const bool fixed = options.image_resolution > 0;
  const Resolution first{fixed ? options.image_resolution : kFirstImage, options.grid_resolution};
  const ForEach for_each = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    for_each_view(count, options.max_threads, task);
  };
  std::vector<StereoPair> pairs(directions.size());
  for_each(pairs.size(), [&](std::size_t i) { pairs[i] = stereo_pair(shape, directions[i]); });
  auto views = draw_stereo_images(shape, pairs, first.image, scene, for_each);
  const Resolution finer =
      resolution_for(shape.low, shape.high, views, first, fixed ? 0 : kFinestImage);
  if (finer.image > first.image)
    views = draw_stereo_images(shape, pairs, finer.image, scene, for_each);
  return {finer, std::move(views)};
}

VoteGrid match(const NormalizedShape& shape, const std::vector<StereoImages>& views,
               int grid_resolution, int threads) {
  VoteAccumulator accumulator(make_voxel_grid(shape.low, shape.high, grid_resolution));
  for_each_view(views.size(), threads, [&](std::size_t i) { cast_votes(views[i], accumulator); });
  return std::move(accumulator).finish();
}

VoteGraph grow_forest(const VoteGrid& votes, double pixel) {
  VoteGraph forest = grow_spanning_tree(votes, pixel);
  if (forest.nodes.empty())
    throw Error(ErrorKind::Empty,
                "no part of the shape can be seen in enough views; give a shape with some volume");
  return forest;
}

/// The genus of a shape that is one closed manifold; not counted where the graph has no cycle.
std::optional<int> most_cycles(const Shape& shape, const NormalizedShape& normalized_shape,
                               const VoteGraph& graph) {
  if (!normalized_shape.oriented || graph.edges.size() < graph.nodes.size()) return {};
  const ShapeSummary summary = summarize(shape);
  if (summary.components != 1 || !summary.handles) return {};
  return static_cast<int>(*summary.handles);
}

/// The tunnels through a volume.
std::optional<int> most_cycles(const Volume& volume, const NormalizedShape&, const VoteGraph&) {
  const auto topology = topology_of(volume);
  return topology ? std::optional(static_cast<int>(topology->tunnels)) : std::nullopt;
}

template <class Input>
VoteGraph collapse(const VoteGraph& graph, const Input& input,
                   const NormalizedShape& normalized_shape, double voxel) {
  SurfaceSides surface(normalized_shape);
  VoteGraph result = cut_welds(graph, surface, voxel);
  result = cut_short_cycles(collapse_branches(result, voxel), voxel);
  result = cut_false_cycles(result, surface, voxel);
  if (const auto most = most_cycles(input, normalized_shape, result))
    result = cut_surplus_cycles(result, *most);
  return prune_leaves(result, voxel);
}

/// The principal axis without the ball in the middle, for a shape of which no edge is left (a rod
/// thinner than what the images show): long for a rod, short for a ball.
VoteGraph middle_line(const NormalizedShape& shape, const Projections& projections, double voxel) {
  const double half = 0.5 * (shape.high.y - shape.low.y);
  const double end = std::max(half - std::max(hull_radius({}, projections), 0.0), voxel);
  return {{{{0, -end, 0}}, {{0, end, 0}}}, {{0, 1}}};
}

/// The silhouettes of a cloud keep within the shape, and so does the hull: the radius is that up to
/// the nearest point where that is more, but not where points are missing.
void widen_to_samples(CurveSkeleton& skeleton, const NormalizedShape& cloud) {
  const double most = median_spacing(cloud);
  std::vector<Vec3> places;
  for (const auto& n : skeleton.nodes) places.push_back(n.position);
  const std::vector<double> distances = nearest_samples(cloud, places);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    double& radius = skeleton.nodes[i].radius;
    radius = std::clamp(distances[i], radius, radius + most);
  }
}

CurveSkeleton with_hull_radii(CurveSkeleton skeleton, const NormalizedShape& shape,
                              const Projections& projections, double pixel) {
  for (auto& n : skeleton.nodes)
    n.radius = std::max(hull_radius(n.position, projections), 0.5 * pixel);
  if (shape.is_point_cloud()) widen_to_samples(skeleton, shape);
  return skeleton;
}

/// Builds the scene of a mesh on first use.
class LazyScene {
 public:
  LazyScene(const NormalizedShape& shape, int threads) : shape_(shape), threads_(threads) {}

  const SurfaceScene& for_use(SurfaceScene::Use use) {
    if (!scene_) run_on(threads_, [&] { scene_.emplace(shape_, use); });
    return *scene_;
  }

 private:
  const NormalizedShape& shape_;
  int threads_;
  std::optional<SurfaceScene> scene_;
};

/// The hull as voxels; gaps in the sampling of a point cloud are bridged.
VoxelSet solid_hull(const NormalizedShape& shape, std::span<const StereoImages> views,
                    const VoxelGrid& grid, const VoteGraph& core) {
  VoxelSet hull = majority(grid, hull_solid(grid, views));
  if (!shape.is_point_cloud()) return hull;
  return bridge_gaps(grid, std::move(hull), core, kLongestGap * median_spacing(shape));
}

/// The graph of the thinned solid. Where that of a cloud has cycles, bodies are parted that only
/// the discs of their samples weld.
VoteGraph thinned_graph(const NormalizedShape& shape, const VoteGrid& votes, const VoxelSet& solid,
                        const VoteGraph& core, double pixel) {
  const auto depth = distance_transform(votes.grid, solid);
  const auto thinned_by = [&](const VoteGrid& order) {
    const VoxelSet thin_set = thin_by_votes(order, solid, depth, core);
    return prune_leaves(graph_of(votes, solid, depth, thin_set, pixel), votes.grid.size);
  };
  VoteGraph graph = thinned_by(votes);
  if (!shape.is_point_cloud() || BranchGraph(graph).cycle_count() == 0) return graph;
  return part_bodies(thinned_by(votes_off_samples(votes, shape)), shape).value_or(std::move(graph));
}

/// Only a mesh has a surface: a cloud has none, and that of a volume is made of steps.
bool is_on_surface(const Shape& shape, Refinement refinement) {
  return refinement == Refinement::Surface && !shape.is_point_cloud();
}
bool is_on_surface(const Volume&, Refinement) { return false; }

/// Sections 4.3 and 4.4 as measured to work.
template <class Input>
VoteGraph graph_by_marrow(const Input& input, const NormalizedShape& shape, const VoteGrid& matched,
                          std::span<const StereoImages> views, double pixel, LazyScene& scene,
                          const ExtractOptions& options, const Recorder& record) {
  using Trace = ExtractTrace;
  const VoxelGrid grid = matched.grid;
  const double voxel = grid.size;

  // 4.3: cleaning by the visual hull, and the tree.
  record.begin("cleaning", 0.55);
  const VoteGrid votes = record.keep(&Trace::cleaned, clean_grid(matched, views));
  record.begin("region growing", 0.65);
  VoteGraph graph = record.keep(&Trace::tree, grow_forest(votes, pixel));

  // 4.4.1: the perceptual core.
  record.begin("perceptual core", 0.7);
  graph = record.keep(&Trace::core, cut_hooks(extract_perceptual_core(graph, voxel), voxel));

  // In place of 4.4.3: the topology of the visual hull.
  record.begin("hull topology", 0.72);
  const VoxelSet solid = record.keep(
      &Trace::solid, supported_solid(grid, solid_hull(shape, views, grid, graph), votes, graph,
                                     shape.is_point_cloud() ? HullOf::Samples : HullOf::Body));
  graph = record.keep(&Trace::thinned, thinned_graph(shape, votes, solid, graph, pixel));

  // 4.4.2: branch collapse, and what the surface says of cycles.
  record.begin("branch collapse", 0.93);
  graph = record.keep(&Trace::collapsed, collapse(graph, input, shape, voxel));

  // 4.4, last paragraph: tips and smoothing.
  record.begin("smoothing", 0.94);
  graph = trim_leaves(cut_hooks(graph, voxel), voxel);
  if (!shape.is_point_cloud())
    graph = cut_leaves_in_sheets(graph, Projections(views), [&]() -> const SurfaceScene& {
      return scene.for_use(SurfaceScene::Use::Questions);
    });
  if (shape.is_point_cloud()) graph = without_lone_nodes(graph);
  return record.keep(&Trace::smoothed, smooth_branches(std::move(graph), options.smoothing_passes));
}

/// Sections 4.3 and 4.4 read literally.
VoteGraph graph_by_paper(const VoteGrid& matched, std::span<const StereoImages> views, double pixel,
                         const ExtractOptions& options, const Recorder& record) {
  using Trace = ExtractTrace;
  record.begin("cleaning", 0.55);
  const VoteGrid votes = record.keep(&Trace::cleaned, clean_grid_by_centres(matched, views));
  record.begin("region growing", 0.65);
  VoteGraph graph = record.keep(&Trace::tree, grow_spanning_tree(votes, pixel));
  record.begin("perceptual core", 0.7);
  graph = record.keep(&Trace::core, prune_to_convergence(std::move(graph)));
  record.begin("branch collapse", 0.93);
  constexpr double kWhateverLiesBetween = std::numeric_limits<double>::infinity();
  graph = record.keep(&Trace::collapsed, collapse_branches(graph, kWhateverLiesBetween));
  graph = record.keep(&Trace::looped, recover_loops(std::move(graph)));
  record.begin("smoothing", 0.94);
  return record.keep(&Trace::smoothed, smooth_branches(std::move(graph), options.smoothing_passes));
}

/// All stages, one after the other; what the next ones do not need is gone.
template <class Input>
CurveSkeleton run(const Input& input, const ExtractOptions& options, ExtractTrace* trace) {
  using Trace = ExtractTrace;
  check(options);
  const Recorder record(options, trace);

  // 4.2, last paragraphs: the shape's own frame.
  record.begin("normalise", 0);
  const Framed framed = in_own_frame(input, options);
  const Normalization frame = record.keep(&Trace::normalization, framed.frame);
  const NormalizedShape& shape = framed.shape;

  // 4.1: silhouettes, distances, medial axes.
  LazyScene scene(shape, options.max_threads);
  const SurfaceScene* by_rays = nullptr;
  if (options.silhouettes == SilhouetteMethod::Embree && !shape.is_point_cloud()) {
    record.begin("surface scene", 0.02);
    by_rays = &scene.for_use(SurfaceScene::Use::Images);
  }
  record.begin("views", 0.05);
  DrawnViews drawn = draw_views(shape, by_rays, view_directions(frame, options), options);
  const Resolution resolution = record.keep(&Trace::resolution, drawn.resolution);
  const auto views = record.keep(&Trace::views, std::move(drawn.views));
  const double pixel = PixelGrid{resolution.image}.pixel();

  // 4.2: matching and voting.
  record.begin("matching", 0.5);
  const VoteGrid matched =
      record.keep(&Trace::votes, match(shape, views, resolution.grid, options.max_threads));

  // 4.3 and 4.4: the graph.
  VoteGraph graph =
      options.rules == Rules::Paper
          ? graph_by_paper(matched, views, pixel, options, record)
          : graph_by_marrow(input, shape, matched, views, pixel, scene, options, record);
  const Projections projections(views);
  if (graph.edges.empty()) graph = middle_line(shape, projections, matched.grid.size);

  // In place of the paper's radii: the silhouettes', then the middle of the surface.
  CurveSkeleton skeleton = skeleton_of(graph);
  const Refinement refinement =
      options.rules == Rules::Paper ? Refinement::None : options.refinement;
  if (refinement != Refinement::None)
    skeleton = with_hull_radii(std::move(skeleton), shape, projections, pixel);
  if (is_on_surface(input, refinement)) {
    record.begin("refinement", 0.95);
    skeleton = recentre(skeleton,
                        {shape, scene.for_use(SurfaceScene::Use::Questions), projections, pixel});
  }
  skeleton = record.keep(&Trace::refined, std::move(skeleton));
  skeleton = record.keep(&Trace::skeleton, to_input_units(skeleton, frame));
  record.begin("done", 1);
  return skeleton;
}

template <class Input>
ExtractTrace run_with_trace(const Input& input, const ExtractOptions& options) {
  ExtractTrace trace;
  run(input, options, &trace);
  return trace;
}

}  // namespace

CurveSkeleton extract(const Shape& shape, const ExtractOptions& options) {
  return run(shape, options, nullptr);
}

CurveSkeleton extract(const Volume& volume, const ExtractOptions& options) {
  return run(volume, options, nullptr);
}

ExtractTrace extract_with_trace(const Shape& shape, const ExtractOptions& options) {
  return run_with_trace(shape, options);
}

ExtractTrace extract_with_trace(const Volume& volume, const ExtractOptions& options) {
  return run_with_trace(volume, options);
}

}  // namespace marrow
