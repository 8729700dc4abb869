#include <marrow/visual_hull.hpp>

#include <analytic_shapes.hpp>

#include "catch.hpp"
#include "random.hpp"
#include "simd_targets.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr int kSide = 96;
const double kPixel = PixelGrid{kSide}.pixel();

struct Seen {
  NormalizedShape shape;
  std::vector<StereoImages> views;
};

Seen seen(const std::string& name) {
  const Shape shape = make_analytic_shape(name, {kLeastResolution}).shape;
  Seen s{apply(normalize(shape), shape), {}};
  for (const Vec3& direction : hemisphere_directions())
    s.views.push_back(draw_stereo_images(s.shape, stereo_pair(s.shape, direction), kSide));
  return s;
}

VoxelGrid grid_of(const Seen& s, int resolution) {
  return make_voxel_grid(s.shape.low, s.shape.high, resolution);
}

std::vector<const ViewImage*> images_of(const Seen& s) {
  std::vector<const ViewImage*> images;
  for (const auto& view : s.views) images.insert(images.end(), {&view.front, &view.side});
  return images;
}

/// The pixel that `p` falls in, and whether it is so near the border of two that rounding decides.
struct Place {
  int x = 0, y = 0;
  bool is_tie = false;
};

Place place_of(const ViewImage& image, const Vec3& p) {
  const PixelGrid pixels{kSide};
  const double u = pixels.to_pixels(dot(image.plane.u, p));
  const double v = pixels.to_pixels(dot(image.plane.v, p));
  const auto near_tie = [](double c) {
    return std::abs(c + 0.5 - std::floor(c + 0.5) - 0.5) > 0.499999;
  };
  return {static_cast<int>(std::floor(u + 0.5)), static_cast<int>(std::floor(v + 0.5)),
          near_tie(u) || near_tie(v)};
}

bool is_set(const BitImage& image, const Place& at) {
  return image.contains(at.x, at.y) && image(at.x, at.y);
}

Vote vote_at(const VoxelGrid& grid, const Vec3& p, ChamferDistance radius = 6) {
  Vote vote;
  const Vec3 q = (p - grid.origin) / grid.size;
  vote.voxel = grid.index(static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z));
  vote.count = 1;
  vote.radius = radius;
  vote.position = p;
  return vote;
}

/// The hull voxel by voxel. Along a row the coordinates are those of the first voxel plus a
/// multiple of the step: what rounding makes of them is part of the result.
VoxelSet slow_hull(const VoxelGrid& grid, const std::vector<StereoImages>& views) {
  const Projections project(views);
  VoxelSet solid(grid);
  for (int z = 1; z < grid.nz - 1; ++z)
    for (int y = 1; y < grid.ny - 1; ++y)
      for (int x = 1; x < grid.nx - 1; ++x) {
        const Vec3 first = grid.center(grid.index(0, y, z));
        bool inside = true;
        for (std::size_t i = 0; i < project.image_count() && inside; ++i) {
          const auto [u0, v0] = project(i, first);
          const auto [u1, v1] = project(i, first + Vec3{grid.size, 0, 0});
          const auto nearest = [](double c) { return static_cast<int>(std::floor(c + 0.5)); };
          inside = is_set(project.image(i).silhouette,
                          {nearest(u0 + x * (u1 - u0)), nearest(v0 + x * (v1 - v0)), false});
        }
        if (inside) solid.insert(grid.index(x, y, z));
      }
  return solid;
}

}  // namespace

TEST_CASE("a point falls where the planes of the images say", "[visual_hull]") {
  const Seen s = seen("s-tube");
  const Projections project(s.views);
  const auto images = images_of(s);
  REQUIRE(project.image_count() == 42);
  const Vec3 p{0.3, -0.2, 0.1};
  const PixelGrid pixels{kSide};
  for (std::size_t i = 0; i < 42; ++i) {
    CHECK(&project.image(i) == images[i]);
    const auto [x, y] = project(i, p);
    CHECK(x == Approx(pixels.to_pixels(dot(images[i]->plane.u, p))));
    CHECK(y == Approx(pixels.to_pixels(dot(images[i]->plane.v, p))));
  }
}

TEST_CASE("the hull is what all silhouettes hold", "[visual_hull]") {
  for (const char* name : {"star", "torus"}) {
    const Seen s = seen(name);
    const VoxelGrid grid = grid_of(s, 40);
    const VoxelSet solid = hull_solid(grid, s.views);
    const auto images = images_of(s);
    int wrong = 0, inside = 0, on_faces = 0;
    for (std::uint32_t v = 0; v < grid.count(); ++v) {
      const int x = grid.x_of(v), y = grid.y_of(v), z = grid.z_of(v);
      if (x == 0 || y == 0 || z == 0 || x == grid.nx - 1 || y == grid.ny - 1 || z == grid.nz - 1) {
        on_faces += solid[v];
        continue;
      }
      bool expected = true, is_tie = false;
      for (const auto* image : images) {
        const Place at = place_of(*image, grid.center(v));
        is_tie = is_tie || at.is_tie;
        expected = expected && is_set(image->silhouette, at);
      }
      inside += expected;
      wrong += !is_tie && solid[v] != expected;
    }
    INFO(name);
    CHECK(wrong == 0);
    CHECK(on_faces == 0);
    CHECK(inside > 100);
  }
}

TEST_CASE("each voxel is asked of each silhouette, to the last bit", "[visual_hull]") {
  // Symmetric shapes have many centres of voxels between two pixels, where rounding decides.
  for (const char* name : {"torus", "star", "capsule"}) {
    const Seen s = seen(name);
    for (const int resolution : {16, 41, 96}) {
      const VoxelGrid grid = grid_of(s, resolution);
      INFO(name << " at " << resolution);
      CHECK(hull_solid(grid, s.views) == slow_hull(grid, s.views));
    }
  }
}

TEST_CASE("a silhouette that touches the edges of its image", "[visual_hull]") {
  Seen s = seen("capsule");
  Random random(4);
  for (auto& view : s.views)
    for (auto* image : {&view.front, &view.side})
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          if (random.below(100) < 99) image->silhouette.set(x, y);
  const VoxelGrid grid = grid_of(s, 40);
  const VoxelGrid larger{grid.origin * 3, grid.size * 3, grid.nx, grid.ny, grid.nz};
  const VoxelSet solid = hull_solid(larger, s.views);
  CHECK(count(solid) > 50);
  CHECK(solid == slow_hull(larger, s.views));
}

TEST_CASE("votes outside a silhouette go", "[visual_hull]") {
  const Seen s = seen("torus");  // the hole is y and x, z is its axis
  const VoxelGrid grid = grid_of(s, 48);
  Random random(1);
  VoteGrid votes{grid, {}};
  for (int i = 0; i < 3000; ++i) {
    const Vec3 low = s.shape.low, high = s.shape.high;
    votes.votes.push_back(
        vote_at(grid, {random.between(low.x, high.x), random.between(low.y, high.y),
                       random.between(low.z, high.z)}));
  }
  const VoteGrid cleaned = clean_grid(votes, s.views);
  CHECK(cleaned.grid == grid);
  const auto images = images_of(s);
  auto kept = cleaned.votes.begin();
  int gone = 0;
  for (const Vote& vote : votes.votes) {
    bool is_clearly_out = false, is_in = true;
    for (const auto* image : images) {
      // Within a pixel of the silhouette is enough; a tie may fall either way.
      const Place at = place_of(*image, vote.position);
      bool near = false;
      for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        near = near || is_set(image->silhouette, {at.x + dx, at.y + dy});
      is_in = is_in && near;
      is_clearly_out = is_clearly_out || (!near && !at.is_tie);
    }
    const bool was_kept = kept != cleaned.votes.end() && kept->position == vote.position;
    if (was_kept) ++kept;
    gone += !was_kept;
    if (is_clearly_out) CHECK_FALSE(was_kept);
    if (is_in) CHECK(was_kept);
  }
  CHECK(kept == cleaned.votes.end());
  CHECK(gone > 500);
  CHECK(cleaned.votes.size() > 500);
}

TEST_CASE("support is the number of medial axes close by", "[visual_hull]") {
  const Seen s = seen("capsule");
  const VoxelGrid grid = grid_of(s, 64);
  const auto images = images_of(s);
  VoteGrid votes{grid, {}};
  for (const double x : {0.003, 0.021, 0.047, 0.083, 0.109}) {
    votes.votes.push_back(vote_at(grid, {x, 0.107, 0.0137}, 3));
    votes.votes.push_back(vote_at(grid, {x, 0.107, 0.0137}, 45));
  }
  const VoteGrid cleaned = clean_grid(votes, s.views);
  REQUIRE(cleaned.votes.size() == votes.votes.size());
  const double tolerance = std::max(0.9 * grid.size / kPixel, 1.0);
  for (const Vote& vote : cleaned.votes) {
    int support = 0, broad = 0;
    for (const auto* image : images) {
      const Place at = place_of(*image, vote.position);
      REQUIRE_FALSE(at.is_tie);
      // The (3,4) distance to the nearest medial pixel, the slow way.
      int least = 1 << 20;
      for (int y = 0; y < kSide; ++y)
        for (const MedialPixel& pixel : image->axis.row(y)) {
          const int dx = std::abs(pixel.x - at.x), dy = std::abs(y - at.y);
          least = std::min(least, 3 * std::max(dx, dy) + std::min(dx, dy));
        }
      support += least / 3.0 <= tolerance;
      broad += least / 3.0 <= std::max(tolerance, 0.2 * pixels_of(vote.radius));
    }
    CHECK(int{vote.support} == support);
    CHECK(int{vote.broad_support} == broad);
  }
  CHECK(cleaned.votes.front().support == 42);  // in the middle of a rod
  CHECK(cleaned.votes.back().support < 30);
  CHECK(cleaned.votes[5].broad_support > cleaned.votes[5].support);
}

TEST_CASE("every instruction set gives votes the same support", "[visual_hull]") {
  for (const char* name : {"torus", "capsule"}) {
    const Seen s = seen(name);
    const VoxelGrid grid = grid_of(s, 64);
    Random random(3);
    VoteGrid votes{grid, {}};
    const Vec3 low = s.shape.low, high = s.shape.high;
    for (int i = 0; i < 501; ++i)
      votes.votes.push_back(vote_at(grid,
                                    {random.between(low.x, high.x), random.between(low.y, high.y),
                                     random.between(low.z, high.z)},
                                    static_cast<ChamferDistance>(random.below(90))));
    const Projections project(s.views);
    VoteGrid expected{grid, {}};
    for (Vote vote : votes.votes) {
      const double tolerance = std::max(0.9 * grid.size / kPixel, 1.0);
      int support = 0, broad = 0;
      bool is_inside = true;
      for (std::size_t i = 0; i < project.image_count(); ++i) {
        const auto [u, v] = project(i, vote.position);
        const int x = static_cast<int>(std::floor(u + 0.5)),
                  y = static_cast<int>(std::floor(v + 0.5));
        const BitImage near = dilate(project.image(i).silhouette, 1);
        is_inside = is_inside && near.contains(x, y) && near(x, y);
        const double away = project.image(i).to_axis(x, y) / 3.0;
        support += away <= tolerance;
        broad += away <= std::max(tolerance, 0.2 * pixels_of(vote.radius));
      }
      vote.support = static_cast<std::uint8_t>(support);
      vote.broad_support = static_cast<std::uint8_t>(broad);
      if (is_inside) expected.votes.push_back(vote);
    }
    CHECK(expected.votes.size() > 20);
    on_each_simd_target([&] { CHECK(clean_grid(votes, s.views) == expected); });
  }
}

TEST_CASE("the majority of 27 decides", "[visual_hull]") {
  const VoxelGrid grid{{0, 0, 0}, 1, 133, 12, 7};  // rows of three words
  Random random(2);
  VoxelSet set(grid);
  for (int z = 1; z < grid.nz - 1; ++z)
    for (int y = 1; y < grid.ny - 1; ++y)
      for (int x = 1; x < grid.nx - 1; ++x)
        if (random.below(9) < 5) set.insert(grid.index(x, y, z));
  const VoxelSet got = majority(grid, set);
  VoxelSet expected(grid);
  for (std::uint32_t v = 0; v < grid.count(); ++v) {
    int sum = 0;
    for (int k = 0; k < 27; ++k) {
      const int x = grid.x_of(v) + k % 3 - 1, y = grid.y_of(v) + k / 3 % 3 - 1,
                z = grid.z_of(v) + k / 9 - 1;
      if (grid.contains(x, y, z)) sum += set[grid.index(x, y, z)];
    }
    if (sum >= 14) expected.insert(v);
  }
  CHECK(got == expected);
  CHECK(count(got) > 20);
}

TEST_CASE("the hull's radius is the room in all silhouettes", "[visual_hull]") {
  const Seen s = seen("capsule");
  const Projections project(s.views);
  const double radius = s.shape.high.z;  // a round rod along y
  CHECK(hull_radius({0, 0.2, 0}, project) == Approx(radius).margin(1.5 * kPixel));
  CHECK(hull_radius({0.5 * radius, 0.2, 0}, project) == Approx(0.5 * radius).margin(1.5 * kPixel));
  CHECK(hull_radius({0, 0.2, 3 * radius}, project) < 0);
  CHECK(hull_radius({30, 0, 0}, project) < 0);  // not in any image
  CHECK(hull_radius({0, 1, 0}, project) < 0.5 * radius);
}
