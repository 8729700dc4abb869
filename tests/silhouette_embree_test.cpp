// Silhouettes by rays against silhouettes by scanlines.
#include <marrow/extract.hpp>
#include <marrow/silhouette.hpp>
#include <marrow/stereo_images.hpp>

#include <analytic_shapes.hpp>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "catch.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "skeleton_distances.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

NormalizedShape normalized_shape(const Shape& shape) { return apply(normalize(shape), shape); }

NormalizedShape made(const char* name, double resolution = scaled(10, 5) * 0.1) {
  return normalized_shape(make_analytic_shape(name, {resolution}).shape);
}

/// The planes of every `step`-th stereo pair.
std::vector<ViewPlane> planes_of(const NormalizedShape& shape, std::size_t step) {
  std::vector<ViewPlane> planes;
  const auto directions = hemisphere_directions();
  for (std::size_t i = 0; i < directions.size(); i += step) {
    const StereoPair pair = stereo_pair(shape, directions[i]);
    planes.push_back(pair.front());
    planes.push_back(pair.side());
  }
  return planes;
}

bool pixel(const BitImage& mask, int x, int y) { return mask.contains(x, y) && mask(x, y); }

/// Set, and one of the four neighbours is not.
bool is_on_boundary(const BitImage& mask, int x, int y) {
  return mask(x, y) && !(pixel(mask, x - 1, y) && pixel(mask, x + 1, y) && pixel(mask, x, y - 1) &&
                         pixel(mask, x, y + 1));
}

/// Whether some of the 3x3 pixels around are set and some are not.
bool is_near_boundary(const BitImage& mask, int x, int y) {
  int set = 0;
  for (int k = 0; k < 9; ++k) set += pixel(mask, x + k % 3 - 1, y + k / 3 - 1);
  return set != 0 && set != 9;
}

struct Disagreement {
  int pixels = 0;
  int off_boundary = 0;  ///< of these, those that no boundary of the first mask is near
  int boundary = 0;      ///< pixels on the boundary of the first mask

  double share() const { return static_cast<double>(pixels) / boundary; }
};

Disagreement compare(const BitImage& a, const BitImage& b) {
  Disagreement d;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      d.boundary += is_on_boundary(a, x, y);
      if (a(x, y) == b(x, y)) continue;
      ++d.pixels;
      d.off_boundary += !is_near_boundary(a, x, y);
    }
  return d;
}

/// The threads that come by; the first waits for a second one, ten seconds at most.
class MeetingPoint {
 public:
  void come_by() {
    {
      const std::lock_guard lock(mutex_);
      threads_.insert(std::this_thread::get_id());
      count_ = threads_.size();
    }
    while (count_ < 2 && std::chrono::steady_clock::now() < end_) std::this_thread::yield();
  }
  std::size_t threads() const { return count_; }

 private:
  std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(10);
  std::mutex mutex_;
  std::set<std::thread::id> threads_;
  std::atomic<std::size_t> count_{0};
};

}  // namespace

TEST_CASE("rays and scanlines differ on the border only, and there seldom", "[embree]") {
  for (const char* name : {"torus", "y-union", "trefoil", "octopus", "quadruped", "plant"}) {
    const NormalizedShape shape = made(name, 1);  // coarse ones have too few border pixels
    const SurfaceScene scene(shape);
    const auto planes = planes_of(shape, 4);
    for (const int n : {256, 512, 1024}) {
      Disagreement sum;
      int worst_off = 0;
      for (const ViewPlane& plane : planes) {
        const BitImage scanlines = fill_triangles(snap(shape, plane, n), shape.triangles, n);
        const Disagreement d = compare(scanlines, fill_by_rays(scene, plane, n));
        sum.pixels += d.pixels;
        sum.boundary += d.boundary;
        worst_off = std::max(worst_off, d.off_boundary);
      }
      INFO(name << " at " << n << ": " << sum.pixels << " of " << sum.boundary << " differ");
      CHECK(sum.boundary > 0);
      CHECK(sum.share() <= (n == 1024 ? 0.01 : 0.005));
      CHECK(worst_off <= 1);
    }
  }
}

TEST_CASE("rays fill what scanlines fill, also in odd shapes and sizes", "[embree]") {
  Random random(1);
  const Shape egg = make_ellipsoid({0.4, 1, 0.7}, 4);
  for (const Shape& shape : {egg, flipped(egg), doubled(egg), unwelded(egg), make_box({1, 2, 0.1}),
                             make_soup(random, 30, 20)}) {
    const NormalizedShape s = normalized_shape(shape);
    const SurfaceScene scene(s);
    for (const int n : {64, 101, 250, 255}) {
      const Frame frame = random.frame();
      const ViewPlane plane{frame.x, frame.y};
      const BitImage scanlines = draw_silhouette(s, plane, n);
      const BitImage rays = draw_silhouette(s, plane, n, &scene);
      const Disagreement d = compare(scanlines, rays);
      INFO("side " << n << ": " << d.pixels << " of " << d.boundary << " differ");
      CHECK(d.pixels <= 2 + 0.02 * d.boundary);
      CHECK(d.off_boundary <= 1);
      CHECK(std::max(count(scanlines), count(rays)) > 100);
    }
  }
}

TEST_CASE("rays see every pixel of a shape that is wider than high, at any place", "[embree]") {
  // Not in the middle of the ball: the box that rays are sent to is not symmetric.
  Shape off_middle = make_box({0.3, 0.05, 0.1});
  for (Vec3& p : off_middle.points) p = p + Vec3{-0.5, 0.6, 0.2};
  const NormalizedShape s = apply(Normalization{}, off_middle);
  const SurfaceScene scene(s);
  for (const ViewPlane& plane : {ViewPlane{{1, 0, 0}, {0, 1, 0}}, ViewPlane{{0, 0, 1}, {0, 1, 0}},
                                 ViewPlane{{0, 1, 0}, {-1, 0, 0}}}) {
    const Disagreement d = compare(fill_triangles(snap(s, plane, 200), s.triangles, 200),
                                   fill_by_rays(scene, plane, 200));
    CHECK(d.boundary > 20);
    CHECK(d.pixels <= d.boundary / 100);
  }
}

TEST_CASE("no triangles, no pixels", "[embree]") {
  const NormalizedShape nothing;
  CHECK(count(fill_by_rays(SurfaceScene(nothing), {{1, 0, 0}, {0, 1, 0}}, 64)) == 0);
}

TEST_CASE("the same rays from one thread and from many, whoever built the tree", "[embree]") {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  // The finest has so many triangles that its tree is built in another way.
  for (const double resolution : {1.0, scaled(20, 1) * 1.0}) {
    const NormalizedShape shape = made("torus", resolution);
    const auto planes = planes_of(shape, 1);
    std::vector<BitImage> one(planes.size()), all(planes.size());
    std::optional<SurfaceScene> scene;
    tbb::task_arena(1).execute([&] {
      scene.emplace(shape);
      for (std::size_t i = 0; i < one.size(); ++i) one[i] = fill_by_rays(*scene, planes[i], 128);
    });
    const SurfaceScene built_by_many(shape);
    MeetingPoint meeting;
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
      meeting.come_by();
      all[i] = fill_by_rays(built_by_many, planes[i], 128);
    });
    CHECK(meeting.threads() >= 2);
    CHECK(one == all);
  }
}

TEST_CASE("skeletons from rays and from scanlines agree", "[embree][extract]") {
  ExtractOptions options;
  options.image_resolution = 256;  // at fewer pixels the rays' border pixels weigh more
  for (const char* name : {"torus", "y", "vessel-tree", "stick-figure", "double-torus"}) {
    const Shape shape = make_analytic_shape(name, {kLeastResolution}).shape;
    options.silhouettes = SilhouetteMethod::Scanline;
    const CurveSkeleton a = extract(shape, options);
    options.silhouettes = SilhouetteMethod::Embree;
    const CurveSkeleton b = extract(shape, options);
    INFO(name);
    CHECK(component_count(a) == component_count(b));
    CHECK(cycle_count(a) == cycle_count(b));
    CHECK(leaf_count(a) == leaf_count(b));
    CHECK(joint_count(a) == joint_count(b));
    double size = 0;
    for (const Vec3& p : shape.points) size = std::max(size, length(p - shape.points[0]));
    CHECK(distances(a, b).mean <= 3e-4 * size);
    CHECK(distances(b, a).mean <= 3e-4 * size);
  }
}

TEST_CASE("skeletons from rays do not depend on threads, and leave TBB as it was", "[embree]") {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  ExtractOptions options;
  options.silhouettes = SilhouetteMethod::Embree;
  options.image_resolution = 128;
  options.grid_resolution = 48;
  options.on_stage = [](std::string_view, double) {
    CHECK(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) == 8);
  };
  const Shape shape = make_analytic_shape("vessel-tree", {kLeastResolution}).shape;
  options.max_threads = 1;
  const CurveSkeleton one = extract(shape, options);
  for (const int threads : {2, 3, 8, 0}) {
    options.max_threads = threads;
    CHECK(extract(shape, options) == one);
  }
}
