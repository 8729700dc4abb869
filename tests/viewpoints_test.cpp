// Directions to look along other than the 21: finer ones, and those that a user gives.
#include <marrow/directions_io.hpp>
#include <marrow/error.hpp>
#include <marrow/extract.hpp>

#include <analytic_shapes.hpp>

#include "catch.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "skeleton_faults.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

std::vector<Vec3> default_directions() {
  const auto directions = hemisphere_directions();
  return {directions.begin(), directions.end()};
}

std::string refusal(const std::string& text) {
  try {
    parse_directions(text, "d.txt");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("81 directions: the 21 and 60 more, spread evenly", "[views]") {
  const std::span<const Vec3> fine = fine_hemisphere_directions();
  REQUIRE(fine.size() == 81);
  CHECK(std::equal(fine.begin(), fine.begin() + 21, hemisphere_directions().begin()));
  CHECK(distinct_directions(fine).size() == 81);
  // Of 162 vertices 12 have five neighbours and 150 six, 15.8 to 18.7 degrees away.
  int five = 0, six = 0;
  for (const Vec3& v : fine) {
    CHECK(length(v) == Approx(1).epsilon(1e-15));
    int near = 0;
    for (const Vec3& w : fine)
      if (!(w == v) && std::abs(dot(v, w)) > 0.94) {
        CHECK(std::abs(dot(v, w)) < 0.9625);
        ++near;
      }
    five += near == 5, six += near == 6;
  }
  CHECK(five == 6);
  CHECK(six == 75);
}

TEST_CASE("directions: parallel ones count once, whatever their length", "[views]") {
  const std::vector<Vec3> given{{0, 0, 2}, {1e200, 0, 0}, {0, 0, -1e-200}, {3, 4, 0}, {-6, -8, 0}};
  const std::vector<Vec3> distinct = distinct_directions(given);
  CHECK(distinct == std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}, {0.6, 0.8, 0}});
  for (const Vec3& wrong : {Vec3{}, Vec3{NAN, 0, 0}, Vec3{0, INFINITY, 0}})
    CHECK_THROWS_AS(distinct_directions(std::array{Vec3{1, 0, 0}, wrong}), Error);
}

TEST_CASE("directions are read from a text", "[views]") {
  CHECK(parse_directions("# along\n1 0 0\n\n  0\t-2e1 .5 # and more\r\n0 0 1", "") ==
        std::vector<Vec3>{{1, 0, 0}, {0, -20, 0.5}, {0, 0, 1}});
  CHECK(refusal("1 0 0\n1 2\n").starts_with("d.txt:2: a direction is three finite numbers"));
  CHECK(refusal("1 0 x\n").starts_with("d.txt:1: "));
  CHECK(refusal("1 0 nan\n").starts_with("d.txt:1: "));
  CHECK(refusal("1 0 0 1\n").starts_with("d.txt:1: there is more"));
  CHECK(refusal("# one\n0 0 0\n").starts_with("d.txt:2: 0 0 0"));
  CHECK(refusal("# none\n").starts_with("d.txt: holds no direction"));
  std::string many;
  for (int i = 0; i < 1024; ++i) many += "1 0 0\n";
  CHECK(refusal(many).empty());
  CHECK(refusal(many + "0 1 0\n").starts_with("d.txt:1025: there are more"));
}

TEST_CASE("a bore that no default view looks through needs one that does", "[views]") {
  const Shape block = make_analytic_shape("bored-block", {0.5}).shape;
  ExtractOptions options;
  options.grid_resolution = 96;
  CHECK(cycle_count(extract(block, options)) == 0);

  options.directions = default_directions();
  options.directions.push_back({1, 1, 1});
  const CurveSkeleton through = extract(block, options);
  CHECK(cycle_count(through) == 1);
  CHECK(component_count(through) == 1);

  // They are in the coordinates of the shape, and turn with it.
  Random random(11);
  const Frame frame = random.frame();
  for (Vec3& d : options.directions) d = from_frame(frame, d) * 7;
  CHECK(cycle_count(extract(moved(block, frame, {1, 2, 3}), options)) == 1);
}

TEST_CASE("what is asked of support means the same for any number of views", "[views]") {
  const Shape shape = make_analytic_shape("y", {0.5}).shape;
  ExtractOptions options = defaults_or_small(128, 64);
  options.views = 81;
  const CurveSkeleton fine = extract(shape, options);
  CHECK(component_count(fine) == 1);
  CHECK(cycle_count(fine) == 0);
  CHECK(leaf_count(fine) == 3);
  const ExtractTrace trace = extract_with_trace(shape, options);
  CHECK(trace.views.size() == 81);
  int most = 0;
  for (const Vote& v : trace.cleaned.votes) most = std::max(most, int{v.support});
  CHECK(most <= 42);
  CHECK(most > 30);
}

TEST_CASE("few views, and many, give a skeleton", "[views]") {
  const Shape shape = make_ellipsoid({1, 3, 0.8}, 3);
  ExtractOptions options;
  options.image_resolution = 64;
  options.grid_resolution = 32;
  std::vector<Vec3> directions;
  Random random(3);
  for (int i = 0; i < scaled(300, 100); ++i) directions.push_back(random.vector());
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, directions.size()}) {
    INFO(count);
    options.directions.assign(directions.begin(),
                              directions.begin() + static_cast<std::ptrdiff_t>(count));
    const CurveSkeleton skeleton = extract(shape, options);
    CHECK(fault_of(skeleton).empty());
    CHECK(component_count(skeleton) == 1);
  }
  options.directions.assign(1025, {1, 0, 0});
  CHECK_THROWS_AS(extract(shape, options), Error);
  options.directions.clear();
  options.views = 42;
  CHECK_THROWS_AS(extract(shape, options), Error);
}

TEST_CASE("the 21 given by hand are the default where the frame is the shape's own", "[views]") {
  const Shape shape = make_analytic_shape("double-torus", {0.5}).shape;
  ExtractOptions options;
  options.image_resolution = 96;
  options.grid_resolution = 48;
  const CurveSkeleton without = extract(shape, options);
  const Frame axes = normalize(shape).axes;
  for (const Vec3& d : hemisphere_directions()) options.directions.push_back(from_frame(axes, d));
  const CurveSkeleton with = extract(shape, options);
  CHECK(component_count(with) == component_count(without));
  CHECK(cycle_count(with) == cycle_count(without));
}
