#include <marrow/stereo_matching.hpp>

#include "catch.hpp"

using namespace marrow;

namespace {

constexpr int kSide = 64;

struct Pixel {
  int x, y;
  ChamferDistance distance;
};

ViewImage image_with(const std::vector<Pixel>& pixels) {
  ViewImage image;
  image.silhouette = BitImage(kSide, kSide);
  BitImage axis(kSide, kSide);
  DistanceMap map(kSide, kSide);
  for (const auto& [x, y, distance] : pixels) {
    axis.set(x, y);
    map(x, y) = distance;
  }
  image.axis = MedialAxis(axis, map);
  return image;
}

StereoImages pair_of(const Frame& frame, const std::vector<Pixel>& front,
                     const std::vector<Pixel>& side) {
  return {{frame}, image_with(front), image_with(side)};
}

VoxelGrid unit_grid(int resolution = 32) {
  return make_voxel_grid({-1, -1, -1}, {1, 1, 1}, resolution);
}

VoteGrid votes_of(std::initializer_list<StereoImages> views) {
  VoteAccumulator accumulator(unit_grid());
  for (const auto& view : views) cast_votes(view, accumulator);
  return std::move(accumulator).finish();
}

const Frame kTilted{{0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}};
const PixelGrid kPixels{kSide};

}  // namespace

TEST_CASE("a match votes where both pixels look", "[stereo_matching]") {
  const auto grid = votes_of({pair_of(kTilted, {{40, 20, 9}}, {{25, 20, 12}})});
  REQUIRE(grid.votes.size() == 1);
  const Vote& vote = grid.votes[0];
  const Vec3 expected = kTilted.x * kPixels.to_length(40) + kTilted.y * kPixels.to_length(20) +
                        kTilted.z * kPixels.to_length(25);
  CHECK(distance(vote.position, expected) < 1e-6);
  CHECK(vote.count == 1);
  CHECK(vote.radius == 9);  // the lesser of both
  const Vec3 centre = grid.grid.center(vote.voxel);
  CHECK(std::abs(centre.x - expected.x) <= grid.grid.size / 2);
  CHECK(std::abs(centre.y - expected.y) <= grid.grid.size / 2);
  CHECK(std::abs(centre.z - expected.z) <= grid.grid.size / 2);
}

TEST_CASE("the lesser distance is the radius, whichever eye sees it", "[stereo_matching]") {
  CHECK(votes_of({pair_of({}, {{40, 20, 12}}, {{25, 20, 9}})}).votes.at(0).radius == 9);
  CHECK(votes_of({pair_of({}, {{40, 20, 9}}, {{25, 20, 12}})}).votes.at(0).radius == 9);
}

TEST_CASE("only pixels of one scanline match, each with each", "[stereo_matching]") {
  const auto apart = votes_of({pair_of({}, {{40, 20, 9}}, {{25, 21, 12}})});
  CHECK(apart.votes.empty());
  const auto grid = votes_of({pair_of({}, {{10, 20, 9}, {30, 20, 6}, {50, 20, 3}, {30, 40, 3}},
                                      {{20, 20, 6}, {45, 20, 6}, {45, 41, 6}})});
  REQUIRE(grid.votes.size() == 6);
  for (const Vote& vote : grid.votes) CHECK(vote.position.y == Approx(kPixels.to_length(20)));
}

TEST_CASE("views that agree add up in one voxel", "[stereo_matching]") {
  const auto a = pair_of({}, {{32, 32, 9}}, {{31, 32, 12}});
  const auto b = pair_of({}, {{32, 32, 6}}, {{32, 32, 30}});
  const auto grid = votes_of({a, b});
  REQUIRE(grid.votes.size() == 1);
  CHECK(grid.votes[0].count == 2);
  CHECK(grid.votes[0].radius == 6);
  CHECK(grid.votes[0].position.z == Approx(0.0).margin(1e-6));
  CHECK(grid == votes_of({b, a}));
}

TEST_CASE("no medial pixels, no votes", "[stereo_matching]") {
  CHECK(votes_of({pair_of({}, {}, {})}).votes.empty());
  CHECK(votes_of({pair_of({}, {{1, 1, 3}}, {})}).votes.empty());
}
