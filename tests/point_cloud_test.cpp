// Point clouds: spacing, frame, silhouettes, bridges, and the whole.
#include <marrow/bounds.hpp>
#include <marrow/error.hpp>
#include <marrow/extract.hpp>
#include <marrow/gap_bridging.hpp>
#include <marrow/nearest_sample.hpp>
#include <marrow/point_silhouette.hpp>
#include <marrow/point_spacing.hpp>

#include <analytic_shapes.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "neighbour_distance_detail.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "skeleton_distances.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

Shape cloud_of(Random& random, std::size_t count) {
  Shape cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = random.vector();
    cloud.points.push_back({p.x, 3 * p.y, random.below(2) == 0 ? 0.1 * p.z : p.z});
  }
  return cloud;
}

/// Points on the triangles of a mesh, by area.
Shape sampled(const Shape& mesh, std::size_t count, double noise = 0) {
  std::vector<double> ends;
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 ab = mesh.points[b] - mesh.points[a], ac = mesh.points[c] - mesh.points[a];
    ends.push_back(sum += length(cross(ab, ac)));
  }
  Random random(5);
  Shape cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::upper_bound(ends.begin(), ends.end(), random.unit() * sum) - ends.begin();
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(at)];
    double u = random.unit(), v = random.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    cloud.points.push_back(p + (q - p) * u + (r - p) * v + random.vector() * noise);
  }
  return cloud;
}

/// The rule of the discs written down plainly, with the same integers.
BitImage plain_silhouette(const NormalizedShape& cloud, const ViewPlane& plane, int side) {
  const SnappedPoints snapped = snap(cloud, plane, side);
  const int step = subpixels_of(side);
  struct Disc {
    int x, y, quarters;
  };
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < cloud.spacing.size(); ++i) {
    const auto scale = static_cast<float>(4 / PixelGrid{side}.pixel());
    const int r = std::max(4, static_cast<int>(cloud.spacing[i] * scale + 0.5F));
    discs.push_back({(snapped.x(i) + step / 2) / step, (snapped.y(i) + step / 2) / step, r});
  }
  const auto squared = [](int dx, int dy) { return 16 * (dx * dx + dy * dy); };
  Image<int> owner(side, side, 0);  // 0: nobody
  BitImage points(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (const Disc& d : discs) {
        const int away = squared(x - d.x, y - d.y);
        if (away <= d.quarters * d.quarters && (owner(x, y) == 0 || d.quarters < owner(x, y)))
          owner(x, y) = d.quarters;
        if (away <= 16) points.set(x, y);
      }
  // Where several discs stand on one pixel only the greatest counts.
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (owner(x, y) == 0) continue;
      int least = 1 << 30;
      for (const Disc& d : discs) {
        int greatest = 0;
        for (const Disc& e : discs)
          if (e.x == d.x && e.y == d.y) greatest = std::max(greatest, e.quarters);
        if (squared(x - d.x, y - d.y) <= greatest * greatest) least = std::min(least, greatest);
      }
      owner(x, y) = least;
    }
  BitImage mask(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (owner(x, y) != 0) mask.set(x, y);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (owner(x, y) != 0) continue;
      int r = 0;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        if (mask.contains(x + dx, y + dy)) r = std::max(r, owner(x + dx, y + dy));
      r -= 4;
      for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u)
          if (r > 0 && squared(u - x, v - y) < r * r) mask.clear(u, v);
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (points(x, y)) mask.set(x, y);
  fill_small_holes(mask, 0.02 * side);
  return mask;
}

Bounds bounds_of(const Shape& shape) {
  Bounds bounds;
  for (const Vec3& p : shape.points) bounds.add(p);
  return bounds;
}

ExtractOptions small_or_default() {
  ExtractOptions options;
  options.image_resolution = scaled(256, 128);
  options.grid_resolution = scaled(128, 64);
  return options;
}

}  // namespace

TEST_CASE("the eighth neighbour is the one that counting finds", "[point_cloud]") {
  Random random(1);
  for (const std::size_t count : {1u, 2u, 8u, 9u, 10u, 16u, 17u, 100u, 700u, 1500u}) {
    std::vector<PointF> points;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 p = random.vector() * (random.below(3) == 0 ? 0.01 : 1.0);
      points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0.0F});
    }
    const auto found = neighbour_distances(points);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<float> all;
      for (std::size_t j = 0; j < count; ++j) {
        if (i == j) continue;
        const float x = points[j][0] - points[i][0], y = points[j][1] - points[i][1];
        all.push_back(std::sqrt(x * x + y * y));
      }
      std::sort(all.begin(), all.end());
      const float expected = all.empty() ? 0 : all[std::min<std::size_t>(all.size(), 8) - 1];
      CHECK(found[i] == expected);
    }
  }
}

TEST_CASE("spacing is in the units of the shape, and capped", "[point_cloud]") {
  Shape grid;
  for (int x = 0; x < 30; ++x)
    for (int y = 0; y < 30; ++y) grid.points.push_back({7e8 + x * 0.5, y * 0.5, 0});
  grid.points.push_back({7e8 + 100, 0, 0});  // alone
  grid.points.push_back(grid.points[77]);    // once more
  const auto spacing = point_spacing(grid);
  REQUIRE(spacing.size() == grid.points.size());
  CHECK(spacing[31 * 14] == Approx(0.5 * std::sqrt(2)).epsilon(1e-4));
  CHECK(spacing[900] <= 1.6);
  CHECK(spacing[77] > 0);
  CHECK(spacing[901] == 0);
  CHECK(point_spacing(make_box({1, 1, 1})).empty());
  CHECK(point_spacing({}).empty());
}

TEST_CASE("neither the order of points nor repeated ones move the frame", "[point_cloud]") {
  Random random(2);
  const Shape cloud = cloud_of(random, 500);
  Shape other = cloud;
  random.shuffle(other.points);
  for (int i = 0; i < 100; ++i) other.points.push_back(other.points[random.below(20)]);
  CHECK(normalize(other) == normalize(cloud));
  const NormalizedShape normalized_cloud = apply(normalize(cloud), cloud);
  CHECK(normalized_cloud.x.size() == 500);
  for (std::size_t i = 0; i < 500; ++i) {
    const Vec3 p{double{normalized_cloud.x[i]}, double{normalized_cloud.y[i]},
                 double{normalized_cloud.z[i]}};
    CHECK(length(p) + static_cast<double>(normalized_cloud.spacing[i]) <= 1 + 1e-6);
  }
}

TEST_CASE("the frame of a cloud weighs every point the same", "[point_cloud]") {
  Shape cross_of_points;
  for (int i = -50; i <= 50; ++i) {
    cross_of_points.points.push_back({0.01 * i, 0, 0});
    cross_of_points.points.push_back({0, 0.1 * i, 0});
    cross_of_points.points.push_back({0, 0, 1.0 * i});
  }
  const Normalization n = normalize(cross_of_points);
  CHECK(std::abs(n.axes.y.z) == Approx(1));
  CHECK(std::abs(n.axes.x.y) == Approx(1));
}

TEST_CASE("silhouettes of clouds are those of the plain rule", "[point_cloud]") {
  Random random(3);
  for (const int side : {64, 96})
    for (const std::size_t count : {3, 40, 100}) {
      const Shape cloud = cloud_of(random, count);
      const NormalizedShape normalized_cloud = apply(normalize(cloud), cloud);
      const Frame frame = random.frame();
      const ViewPlane plane{frame.x, frame.y};
      const BitImage mask = draw_point_silhouette(normalized_cloud, plane, side);
      CHECK(mask == plain_silhouette(normalized_cloud, plane, side));
      for (int i = 0; i < side; ++i)
        CHECK_FALSE((mask(i, 0) || mask(0, i) || mask(i, side - 1) || mask(side - 1, i)));
    }
}

TEST_CASE("a sampled sheet has no holes and its own size", "[point_cloud]") {
  Random random(4);
  Shape sheet;
  for (int i = 0; i < 4000; ++i)
    sheet.points.push_back({random.between(-1, 1), random.between(-2, 2), 0});
  const NormalizedShape cloud = apply(normalize(sheet), sheet);
  constexpr int kSide = 128;
  const BitImage mask = draw_point_silhouette(cloud, {{1, 0, 0}, {0, 1, 0}}, kSide);
  const double scale = 1 / PixelGrid{kSide}.pixel();
  const double area = static_cast<double>(cloud.high.x - cloud.low.x) *
                      static_cast<double>(cloud.high.y - cloud.low.y) * scale * scale;
  CHECK(static_cast<double>(count(mask)) == Approx(area).epsilon(0.12));
  BitImage filled = mask;
  fill_small_holes(filled, kSide);
  CHECK(filled == mask);
}

TEST_CASE("only a leaf that points at another part is bridged to it", "[point_cloud]") {
  const VoxelGrid grid{{0, 0, 0}, 1, 41, 21, 21};
  VoxelSet hull(grid);
  VoteGraph core;
  const auto rod = [&](int from, int to, int y) {
    for (int x = from; x <= to; ++x) {
      const std::uint32_t v = grid.index(x, y, 10);
      hull.insert(v);
      core.nodes.push_back({grid.center(v), 1, 30, 30, v});
      if (x > from)
        core.edges.push_back({static_cast<NodeId>(core.nodes.size() - 2),
                              static_cast<NodeId>(core.nodes.size() - 1)});
    }
  };
  rod(3, 12, 10);
  rod(18, 30, 10);  // in line, five voxels off
  const auto before = count(hull);
  CHECK(count(bridge_gaps(grid, hull, core, 6)) == before + 5);
  CHECK(count(bridge_gaps(grid, hull, core, 4)) == before);
  rod(3, 12, 14);  // beside the first
  CHECK(count(bridge_gaps(grid, hull, core, 6)) == before + 10 + 5);
}

TEST_CASE("the nearest sample is the one that counting finds", "[point_cloud]") {
  Random random(6);
  const Shape cloud = cloud_of(random, 300);
  const NormalizedShape normalized_cloud = apply(normalize(cloud), cloud);
  std::vector<Vec3> places{{0, 0, 0}, {0, 1, 0}, {0, -1.5, 0}};
  for (int i = 0; i < 50; ++i) places.push_back(random.vector());
  const auto found = nearest_samples(normalized_cloud, places);
  for (std::size_t k = 0; k < places.size(); ++k) {
    double least = 1e9;
    for (std::size_t i = 0; i < normalized_cloud.x.size(); ++i)
      least = std::min(
          least, distance(places[k], {double{normalized_cloud.x[i]}, double{normalized_cloud.y[i]},
                                      double{normalized_cloud.z[i]}}));
    CHECK(found[k] == least);
  }
}

TEST_CASE("sampled shapes have the skeletons of the shapes", "[point_cloud]") {
  for (const char* name : {"capsule", "torus", "star"}) {
    const AnalyticShape made = make_analytic_shape(name);
    const Shape cloud = sampled(made.shape, static_cast<std::size_t>(scaled(10000, 3000)));
    const CurveSkeleton s = extract(cloud, small_or_default());
    INFO(name);
    CHECK(component_count(s) == made.components);
    CHECK(cycle_count(s) == made.cycles);
    if (made.leaves) CHECK(leaf_count(s) == *made.leaves);
    const double diagonal = bounds_of(cloud).diagonal();
    CHECK(distances(s, made.truth).mean < 0.006 * diagonal);
    CHECK(distances(made.truth, s).mean < 0.006 * diagonal);
    double radius_error = 0;
    for (const auto& n : s.nodes) {
      const auto nearest = std::min_element(
          made.truth.nodes.begin(), made.truth.nodes.end(), [&](const auto& a, const auto& b) {
            return distance(a.position, n.position) < distance(b.position, n.position);
          });
      radius_error += std::abs(n.radius - nearest->radius);
    }
    CHECK(radius_error / static_cast<double>(s.nodes.size()) < 0.01 * diagonal);
  }
}

TEST_CASE("a cloud gives the same bytes in any order and for any threads", "[point_cloud]") {
  const Shape cloud = sampled(make_ellipsoid({1, 2, 0.5}, 3), 2000, 0.01);
  ExtractOptions options;
  options.image_resolution = 96;
  options.grid_resolution = 48;
  options.max_threads = 1;
  const CurveSkeleton one = extract(cloud, options);
  options.max_threads = 3;
  CHECK(extract(cloud, options) == one);
  Shape shuffled = cloud;
  Random random(8);
  random.shuffle(shuffled.points);
  shuffled.points.insert(shuffled.points.end(), cloud.points.begin(), cloud.points.begin() + 50);
  CHECK(extract(shuffled, options) == one);
  options.closing = 5;
  CHECK(cycle_count(extract(cloud, options)) == 0);
  options.closing = 25;
  CHECK_THROWS_AS(extract(cloud, options), Error);
}

TEST_CASE("clouds of few points end in a skeleton", "[point_cloud]") {
  ExtractOptions options;
  options.image_resolution = 64;
  options.grid_resolution = 32;
  Random random(9);
  for (std::size_t count = 2; count < 12; ++count) {
    const CurveSkeleton s = extract(cloud_of(random, count), options);
    CHECK_FALSE(s.edges.empty());
    for (const auto& n : s.nodes) CHECK((std::isfinite(n.radius) && n.radius > 0));
  }
}
