#include <marrow/bounds.hpp>
#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/skeleton_io.hpp>
#include <marrow/smoothing.hpp>

#include <analytic_shapes.hpp>
#include <tbb/global_control.h>
#include <tube.hpp>

#include <bit>
#include <map>

#include "catch.hpp"
#include "graphs.hpp"
#include "mesh_checks.hpp"
#include "random.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Coarse, for properties that hold at any resolution.
ExtractOptions quick() {
  ExtractOptions options;
  options.image_resolution = scaled(128, 96);
  options.grid_resolution = scaled(64, 40);
  return options;
}

const Shape& made(const std::string& name) {
  static std::map<std::string, Shape> all;
  const auto [found, is_new] = all.try_emplace(name);
  if (is_new) found->second = make_analytic_shape(name, {kLeastResolution}).shape;
  return found->second;
}

Bounds bounds_of(const Shape& shape) {
  Bounds box;
  for (const auto& t : shape.triangles)
    for (const auto i : t) box.add(shape.points[i]);
  return box;
}

struct Counts {
  int components, cycles, leaves;

  friend bool operator==(const Counts&, const Counts&) = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.components << " parts, " << c.cycles << " cycles, " << c.leaves << " leaves";
}

Counts counts(const CurveSkeleton& s) {
  return {component_count(s), cycle_count(s), leaf_count(s)};
}

void check_is_valid(const CurveSkeleton& s, const Shape& shape) {
  const Bounds bounds = bounds_of(shape);
  const double margin = 0.01 * bounds.diagonal();
  REQUIRE_FALSE(s.nodes.empty());
  int bad_nodes = 0, bad_edges = 0;
  for (const auto& [p, radius, section_radius] : s.nodes) {
    const bool is_in = p.x >= bounds.low.x - margin && p.x <= bounds.high.x + margin &&
                       p.y >= bounds.low.y - margin && p.y <= bounds.high.y + margin &&
                       p.z >= bounds.low.z - margin && p.z <= bounds.high.z + margin;
    bad_nodes += !is_in || !(radius > 0) || !std::isfinite(radius);  // NaN is in no box
    bad_nodes += section_radius != 0 && !(section_radius >= radius);
  }
  for (const auto& [a, b] : s.edges) bad_edges += a >= b || b >= s.nodes.size();
  CHECK(bad_nodes == 0);
  CHECK(bad_edges == 0);
  CHECK(std::is_sorted(s.edges.begin(), s.edges.end()));
  CHECK(std::adjacent_find(s.edges.begin(), s.edges.end()) == s.edges.end());
}

/// The greatest distance of nodes and difference of radii, where both have the same edges.
double difference(const CurveSkeleton& a, const CurveSkeleton& b) {
  if (a.nodes.size() != b.nodes.size() || a.edges != b.edges) return 1e300;
  double most = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    most = std::max({most, distance(a.nodes[i].position, b.nodes[i].position),
                     std::abs(a.nodes[i].radius - b.nodes[i].radius)});
  return most;
}

template <class Map>
Shape mapped(Shape shape, Map map) {
  for (auto& p : shape.points) p = map(p);
  return shape;
}

template <class Map>
CurveSkeleton mapped_skeleton(CurveSkeleton s, Map map, double scale = 1) {
  for (auto& n : s.nodes) n = {map(n.position), n.radius * scale};
  return s;
}

ErrorKind failure(const Shape& shape, const ExtractOptions& options = quick()) {
  try {
    extract(shape, options);
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.kind();
  }
  FAIL("no error");
  return ErrorKind::Internal;
}

const std::vector<std::string> kSome{"s-tube", "stick-figure", "figure-eight", "y-union"};

}  // namespace

TEST_CASE("turns and mirrors of the axes turn the skeleton", "[extract]") {
  // Where a shape is symmetric its own frame takes its signs from the input's, so that the numbers
  // of a turned copy may be others; those without a symmetry keep them.
  const std::vector<std::string> without_symmetry{"hand", "vessel-tree", "y-union"};
  std::vector<std::string> names = kSome;
  names.insert(names.end(), without_symmetry.begin(), without_symmetry.end());
  for (const auto& name : names) {
    const Shape& shape = made(name);
    const CurveSkeleton before = extract(shape, quick());
    const double diagonal = bounds_of(shape).diagonal();
    const bool is_exact =
        std::find(without_symmetry.begin(), without_symmetry.end(), name) != without_symmetry.end();
    const auto check = [&](const char* what, bool is_turn, auto map) {
      INFO(name << ": " << what);
      const CurveSkeleton after = extract(mapped(shape, map), quick());
      CHECK(counts(after) == counts(before));
      if (is_exact && is_turn)
        CHECK(difference(after, mapped_skeleton(before, map)) <= 4e-6 * diagonal);
    };
    check("y z x", true, [](const Vec3& p) { return Vec3{p.y, p.z, p.x}; });
    check("-x -y z", true, [](const Vec3& p) { return Vec3{-p.x, -p.y, p.z}; });
    check("y -x z", true, [](const Vec3& p) { return Vec3{p.y, -p.x, p.z}; });
    if (!is_exact) check("-x y z", false, [](const Vec3& p) { return Vec3{-p.x, p.y, p.z}; });
  }
}

TEST_CASE("a moved shape has a moved skeleton", "[extract]") {
  for (const auto& name : kSome) {
    INFO(name);
    const Shape& shape = made(name);
    const CurveSkeleton before = extract(shape, quick());
    const double diagonal = bounds_of(shape).diagonal();
    for (const Vec3 by : {Vec3{1, 2, -4}, Vec3{1024, -512, 0.25}}) {
      const auto move = [&](const Vec3& p) { return p + by; };
      CHECK(difference(extract(mapped(shape, move), quick()), mapped_skeleton(before, move)) <=
            4e-6 * diagonal);
    }
  }
}

TEST_CASE("a scaled shape has a scaled skeleton", "[extract]") {
  for (const auto& name : kSome) {
    const Shape& shape = made(name);
    const CurveSkeleton before = extract(shape, quick());
    for (const double scale : {0.5, 1024.0, 0x1p-600, 0x1p600}) {
      INFO(name << " times " << scale);
      const auto times = [&](const Vec3& p) { return p * scale; };
      const CurveSkeleton after = extract(mapped(shape, times), quick());
      CHECK(difference(mapped_skeleton(
                           after, [&](const Vec3& p) { return p / scale; }, 1 / scale),
                       before) <= 4e-6 * bounds_of(shape).diagonal());
    }
  }
}

TEST_CASE("how a surface is written is nothing", "[extract]") {
  Random random(1);
  for (const auto& name : kSome) {
    INFO(name);
    const Shape& shape = made(name);
    const CurveSkeleton before = extract(shape, quick());
    CHECK(extract(shape, quick()) == before);  // once more
    CHECK(extract(reordered(shape, random, false), quick()) == before);
    Shape far = shape;
    far.points.push_back({1e6, -1e9, 3});
    far.points.insert(far.points.begin(), {-1e12, 7, 7});
    for (auto& t : far.triangles)
      for (auto& i : t) ++i;
    CHECK(extract(far, quick()) == before);
    CHECK(extract(flipped(shape), quick()) == before);
    // Mixed orientations and doubled faces leave the surface without a say on cycles.
    CHECK(counts(extract(reordered(shape, random), quick())) == counts(before));
    CHECK(counts(extract(doubled(shape), quick())) == counts(before));
    CHECK(counts(extract(unwelded(shape), quick())) == counts(before));
  }
}

TEST_CASE("the number of threads is nothing", "[extract]") {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  const auto active = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  for (const char* name : {"vessel-tree", "trefoil"}) {
    INFO(name);
    ExtractOptions options = quick();
    options.max_threads = 1;
    const CurveSkeleton one = extract(made(name), options);
    for (const int threads : {2, 3, 8, 0, 8}) {
      options.max_threads = threads;
      options.on_stage = [&](std::string_view, double) { CHECK(active() == 8); };
      CHECK(extract(made(name), options) == one);
    }
  }
}

TEST_CASE("small thin parts get finer images, unless the images are given", "[extract]") {
  // Needles through a thick body, thinner than a pixel of 256.
  const Shape& body = made("star");
  const Vec3 half = bounds_of(body).high;
  Shape shape = body;
  for (const double x : {-0.7, 0.7}) {
    const Shape needle = make_ellipsoid(Vec3{0.004, 0.45, 0.004} * half.x, 2);
    append(shape, moved(needle, Frame{}, {x * half.x, 0, 0}));
  }
  ExtractOptions options;
  CHECK(extract_with_trace(body, options).resolution.image == 256);
  CHECK(extract_with_trace(shape, options).resolution == Resolution{512, 192});
  options.image_resolution = 128;
  const ExtractTrace given = extract_with_trace(shape, options);
  CHECK(given.resolution.image == 128);
  CHECK(given.views[0].front.silhouette.width() == 128);
}

TEST_CASE("options out of range are refused", "[extract]") {
  const auto refused = [](auto change) {
    ExtractOptions options;
    change(options);
    return failure(made("capsule"), options) == ErrorKind::Usage;
  };
  for (const int n : {-1, 1, 63, 1025}) {
    CHECK(refused([&](ExtractOptions& o) { o.image_resolution = n; }));
  }
  for (const int n : {-1, 0, 15, 257}) {
    CHECK(refused([&](ExtractOptions& o) { o.grid_resolution = n; }));
  }
  CHECK(refused([](ExtractOptions& o) { o.smoothing_passes = -1; }));
  CHECK(refused([](ExtractOptions& o) { o.max_threads = -1; }));
}

TEST_CASE("where there is nothing there is no skeleton", "[extract]") {
  CHECK(failure({}) == ErrorKind::Empty);
  CHECK(failure({{{1, 2, 3}}, {}}) == ErrorKind::Empty);
  CHECK(failure({{{1, 2, 3}, {1, 2, 3}}, {}}) == ErrorKind::Empty);
  CHECK(failure({{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}}) == ErrorKind::Empty);
}

TEST_CASE("poor shapes give a skeleton or an error", "[extract]") {
  const Shape ball = make_ellipsoid({1, 1, 1}, 3);
  Shape two_balls = ball;
  for (const auto& p : ball.points) two_balls.points.push_back(p + Vec3{30, 0, 0});
  const auto n = static_cast<std::uint32_t>(ball.points.size());
  for (const auto& [a, b, c] : ball.triangles) two_balls.triangles.push_back({a + n, b + n, c + n});
  const std::vector<std::pair<const char*, Shape>> shapes{
      {"triangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}},
      {"collinear", {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}},
      {"plate", {{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}}},
      {"needle", make_box({1e-9, 1, 1e-9})},
      {"rod", make_box({0.001, 1, 0.001})},
      {"two balls", two_balls},
      {"ball", ball},
      {"cube", make_box({1, 1, 1})},
      {"huge cube", make_box({1e300, 1e300, 1e300})},
      {"tiny cube", make_box({1e-300, 1e-300, 1e-300})}};
  for (const auto& [name, shape] : shapes) {
    INFO(name);
    try {
      check_is_valid(extract(shape, quick()), shape);
    } catch (const Error& error) {
      WARN(name << ": " << error.what());
      CHECK(error.kind() != ErrorKind::Internal);
    }
  }
  CHECK(counts(extract(two_balls, quick())).components == 2);
}

TEST_CASE("the core ends where limbs end, not on the way back", "[extract]") {
  ExtractOptions coarse;
  coarse.image_resolution = 64;
  coarse.grid_resolution = 64;
  for (const char* name : {"snake", "rings", "plant"}) {  // their trees have hooks
    INFO(name);
    const ExtractTrace trace = extract_with_trace(made(name), coarse);
    CHECK(cut_hooks(trace.core, trace.cleaned.grid.size).nodes == trace.core.nodes);
  }
}

TEST_CASE("stages come in order, and may stop the work", "[extract]") {
  ExtractOptions options = quick();
  std::vector<double> done;
  options.on_stage = [&](std::string_view, double share) { done.push_back(share); };
  const ExtractTrace trace = extract_with_trace(made("y"), options);
  CHECK(done.size() > 5);
  CHECK(done.front() == 0);
  CHECK(done.back() == 1);
  CHECK(std::is_sorted(done.begin(), done.end()));
  CHECK(trace.skeleton == extract(made("y"), quick()));
  CHECK(trace.views.size() == 21);
  options.on_stage = [](std::string_view, double share) {
    if (share > 0.5) throw Error(ErrorKind::Limit, "stopped");
  };
  CHECK(failure(made("y"), options) == ErrorKind::Limit);
}
