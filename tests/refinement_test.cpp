#include <marrow/extract.hpp>
#include <marrow/refinement.hpp>

#include <analytic_shapes.hpp>
#include <tube.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "mesh_checks.hpp"
#include "random.hpp"
#include "sample_shapes.hpp"
#include "scale.hpp"
#include "skeleton_distances.hpp"
#include "skeleton_faults.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// A shape in its own frame, ready for recentring.
class Stage {
 public:
  explicit Stage(const Shape& shape, SurfaceScene::Use use = SurfaceScene::Use::Questions)
      : frame_(normalize(shape)), shape_(apply(frame_, shape)), scene_(shape_, use) {
    constexpr int kImage = 128;
    for (const Vec3& direction : hemisphere_directions())
      views_.push_back(draw_stereo_images(shape_, stereo_pair(shape_, direction), kImage));
    pixel_ = PixelGrid{kImage}.pixel();
  }

  /// `skeleton`, and what comes of it, in the units of the shape.
  CurveSkeleton recentred(CurveSkeleton skeleton) const {
    const double scale = 1 / frame_.length_to_input(1);
    for (auto& n : skeleton.nodes)
      n = {frame_.to_normalized(n.position), n.radius * scale, n.section_radius * scale};
    const Projections projections(views_);
    return to_input_units(recentre(skeleton, {shape_, scene_, projections, pixel_}), frame_);
  }

 private:
  Normalization frame_;
  NormalizedShape shape_;
  SurfaceScene scene_;
  std::vector<StereoImages> views_;
  double pixel_ = 0;
};

CurveSkeleton straight_line(const Vec3& from, const Vec3& to, int edges, double radius) {
  CurveSkeleton s;
  for (int i = 0; i <= edges; ++i)
    s.nodes.push_back({from + (to - from) * (double(i) / edges), radius});
  for (int i = 0; i < edges; ++i) s.edges.push_back({NodeId(i), NodeId(i + 1)});
  return s;
}

/// Every node moved by up to `most` along each axis.
CurveSkeleton shaken(CurveSkeleton s, double most) {
  Random random(11);
  for (auto& n : s.nodes) n.position += random.vector() * most;
  return s;
}

void check_same_topology(const CurveSkeleton& a, const CurveSkeleton& b) {
  CHECK(component_count(a) == component_count(b));
  CHECK(cycle_count(a) == cycle_count(b));
  CHECK(leaf_count(a) == leaf_count(b));
  CHECK(joint_count(a) == joint_count(b));
}

/// Radii are the distances to the surface, and no section is smaller.
void check_radii(const CurveSkeleton& s, const Shape& shape) {
  double worst = 0;
  for (const auto& n : s.nodes) {
    worst = std::max(worst, std::abs(n.radius - distance_to_surface(shape, n.position)));
    CHECK(n.section_radius >= n.radius);
  }
  CHECK(worst < 1e-5);
}

/// A tube along the x axis.
Shape tube(double from, double to, double radius) {
  return make_tube(sample_curve(40, false,
                                [&](double t) {
                                  return Ball{{from + (to - from) * t, 0, 0}, radius};
                                }),
                   48);
}

/// Greatest distance of a node from the x axis.
double off_axis(const CurveSkeleton& s) {
  double most = 0;
  for (const auto& n : s.nodes) most = std::max(most, length({0, n.position.y, n.position.z}));
  return most;
}

}  // namespace

TEST_CASE("a shaken line goes back to the axis of a capsule", "[refinement]") {
  const Shape capsule = tube(-1, 1, 0.25);
  const CurveSkeleton line = shaken(straight_line({-0.8, 0, 0}, {1.1, 0, 0}, 60, 0.2), 0.1);
  const CurveSkeleton s = Stage(capsule).recentred(line);
  CHECK(fault_of(s).empty());
  check_same_topology(s, line);
  check_radii(s, capsule);
  CHECK(off_axis(s) < 0.005);
  double low = 0, high = 0;
  for (const auto& n : s.nodes) {
    low = std::min(low, n.position.x), high = std::max(high, n.position.x);
    CHECK(n.radius == Approx(0.25).epsilon(0.01));
  }
  CHECK(low == Approx(-1).margin(0.03));  // too short there, too long here
  CHECK(high == Approx(1).margin(0.03));
}

TEST_CASE("a ring stays a ring, in the middle of its torus", "[refinement]") {
  const AnalyticShape torus = make_analytic_shape("torus");
  const CurveSkeleton ring = shaken(torus.truth, 0.05);
  const CurveSkeleton s = Stage(torus.shape).recentred(ring);
  check_same_topology(s, ring);
  check_radii(s, torus.shape);
  CHECK(leaf_count(s) == 0);
  CHECK(s.nodes.size() == s.edges.size());
  const Distances off = distances(s, torus.truth);
  CHECK(off.most < 0.01);
  CHECK(off.most < 0.2 * distances(ring, torus.truth).most);
}

TEST_CASE("a flat section keeps the line in its middle and widens the section", "[refinement]") {
  const Shape plank = make_box({2, 0.4, 0.1});
  const CurveSkeleton line = shaken(straight_line({-1.6, 0, 0}, {1.6, 0, 0}, 80, 0.1), 0.05);
  const CurveSkeleton s = Stage(plank).recentred(line);
  check_same_topology(s, line);
  check_radii(s, plank);
  for (const auto& n : s.nodes) {
    CHECK(std::abs(n.position.z) < 0.004);
    CHECK(std::abs(n.position.y) < 0.1);
    if (std::abs(n.position.x) < 1.5) CHECK(n.section_radius > 1.3 * n.radius);
  }
}

TEST_CASE("a joint goes to where its limbs point to", "[refinement]") {
  for (const char* name : {"y-union", "y"}) {
    INFO(name);
    const AnalyticShape y = make_analytic_shape(name);
    CurveSkeleton off = y.truth;
    const std::vector<int> degree = degrees(off);
    const std::size_t joint =
        static_cast<std::size_t>(std::find(degree.begin(), degree.end(), 3) - degree.begin());
    REQUIRE(joint < degree.size());
    const Vec3 truth = off.nodes[joint].position;
    const double radius = off.nodes[joint].radius;
    off.nodes[joint].position += Vec3{0.3, 0.5, 0.1} * radius;
    const CurveSkeleton s = Stage(y.shape).recentred(off);
    check_same_topology(s, off);
    double nearest = radius;
    const std::vector<int> after = degrees(s);
    for (std::size_t n = 0; n < after.size(); ++n)
      if (after[n] == 3) nearest = std::min(nearest, distance(s.nodes[n].position, truth));
    CHECK(nearest < 0.15 * radius);
  }
}

TEST_CASE("a line does not end in one of the corners of a blunt end", "[refinement]") {
  const Shape post = make_box({1, 0.25, 0.25});
  for (const double side : {-1.0, 1.0}) {
    CurveSkeleton line = straight_line({-0.6, 0, 0}, {0.75, 0, 0}, 30, 0.2);
    for (int i = 1; i <= 8; ++i) {  // into the corner at (1, .25, side * .25)
      const auto last = static_cast<NodeId>(line.nodes.size());
      line.nodes.push_back({{0.75 + 0.025 * i, 0.025 * i, 0.025 * i * side}, 0.25 - 0.025 * i});
      line.edges.push_back({last - 1, last});
    }
    const CurveSkeleton s = Stage(post).recentred(line);
    check_same_topology(s, line);
    CHECK(off_axis(s) < 0.05);
    double high = 0;
    for (const auto& n : s.nodes) high = std::max(high, n.position.x);
    CHECK(high == Approx(0.75).margin(0.05));
  }
}

TEST_CASE("a line follows a foot to its toes", "[refinement]") {
  const auto leg = sample_curve(40, false, [](double t) { return Ball{{0, 0, 2 * t}, 0.2}; });
  Shape both = make_tube(leg, 48);
  append(both, make_tube(sample_curve(40, false,
                                      [](double t) {
                                        return Ball{{0.55 * t, 0, 0}, 0.2 - 0.18 * t};
                                      }),
                         48));
  CurveSkeleton line = straight_line({0, 0, 1.5}, {0, 0, 0}, 30, 0.15);
  for (int i = 1; i <= 11; ++i) {
    const auto last = static_cast<NodeId>(line.nodes.size());
    line.nodes.push_back({{0.05 * i, 0, 0}, 0.03});
    line.edges.push_back({last - 1, last});
  }
  const CurveSkeleton s = Stage(both).recentred(line);
  check_same_topology(s, line);
  double high = 0;
  for (const auto& n : s.nodes) high = std::max(high, n.position.x);
  CHECK(high == Approx(0.55).margin(0.04));
}

TEST_CASE("a line that stops at a bend goes on round it", "[refinement]") {
  const auto bent = [](double t) {
    const Vec3 p = t < 0.75 ? Vec3{0, 0, 2 - t * 8 / 3} : Vec3{t * 2 - 1.5, 0, 0};
    return Ball{p, 0.15};
  };
  const Shape leg = make_tube(sample_curve(60, false, bent), 48);
  const CurveSkeleton line = straight_line({0, 0, 1.8}, {0, 0, 0.1}, 30, 0.1);
  const CurveSkeleton s = Stage(leg).recentred(line);
  CHECK(fault_of(s).empty());
  check_same_topology(s, line);
  double high = 0;
  for (const auto& n : s.nodes) {
    high = std::max(high, n.position.x);
    CHECK(n.radius > 0.1);
  }
  CHECK(high == Approx(0.5).margin(0.05));
}

TEST_CASE("walls inside the shape are no walls", "[refinement]") {
  Shape both = tube(-1, 0.1, 0.25);
  append(both, tube(-0.1, 1, 0.25));  // each has a cap within the other
  const CurveSkeleton line = shaken(straight_line({-1, 0, 0}, {1, 0, 0}, 60, 0.2), 0.05);
  const CurveSkeleton s = Stage(both).recentred(line);
  check_same_topology(s, line);
  CHECK(off_axis(s) < 0.005);
  for (const auto& n : s.nodes) CHECK(n.radius == Approx(0.25).epsilon(0.01));
}

TEST_CASE("open ends, holes and soups do not lead a line astray", "[refinement]") {
  const Shape closed = tube(-1, 1, 0.25);
  Shape open{closed.points, {}}, with_holes{closed.points, {}};
  for (std::size_t i = 0; i < closed.triangles.size(); ++i) {
    const Triangle& t = closed.triangles[i];
    const Vec3 middle =
        (closed.points[t[0]] + closed.points[t[1]] + closed.points[t[2]]) * (1.0 / 3);
    if (std::abs(middle.x) < 0.99) open.triangles.push_back(t);
    if (i % 20 != 0) with_holes.triangles.push_back(t);
  }
  Random random(2);
  const CurveSkeleton line = shaken(straight_line({-0.8, 0, 0}, {0.8, 0, 0}, 60, 0.2), 0.05);
  for (const Shape& shape : {open, with_holes, reordered(unwelded(closed), random)}) {
    const CurveSkeleton s = Stage(shape).recentred(line);
    CHECK(fault_of(s).empty());
    check_same_topology(s, line);
    CHECK(off_axis(s) < 0.01);
    for (const auto& n : s.nodes) CHECK(n.radius == Approx(0.25).epsilon(0.02));
  }
}

TEST_CASE("a line outside goes into the limb beside it", "[refinement]") {
  const Shape arc = make_tube(sample_curve(80, false,
                                           [](double t) {
                                             const double x = 2 * t - 1;
                                             return Ball{{x, 0.8 * x * x, 0}, 0.1};
                                           }),
                              32);
  const CurveSkeleton chord = straight_line({-0.5, 0.2, 0}, {0.5, 0.2, 0}, 30, 0.02);
  const CurveSkeleton s = Stage(arc).recentred(chord);
  check_same_topology(s, chord);
  for (const auto& [a, b] : s.edges) {
    const Vec3 middle = (s.nodes[a].position + s.nodes[b].position) * 0.5;
    CHECK(winding_number(arc, middle) == 1);
  }
}

TEST_CASE("which tree finds the surface is nothing", "[refinement]") {
  for (const char* name : {"y-union", "quadruped"}) {
    const AnalyticShape made = make_analytic_shape(name, {kLeastResolution});
    const CurveSkeleton line = shaken(made.truth, 0.02);
    const auto by = [&](SurfaceScene::Use use) { return Stage(made.shape, use).recentred(line); };
    CHECK(by(SurfaceScene::Use::Images) == by(SurfaceScene::Use::Questions));
  }
}

TEST_CASE("recentring changes no topology and no other end does", "[refinement]") {
  for (const char* name : {"stick-figure", "figure-eight", "star-union", "cube-frame", "hand"}) {
    INFO(name);
    const AnalyticShape made = make_analytic_shape(name, {kLeastResolution});
    ExtractOptions options;
    options.image_resolution = scaled(128, 96);
    options.grid_resolution = scaled(64, 48);
    const auto with = [&](Refinement refinement) {
      options.refinement = refinement;
      return extract(made.shape, options);
    };
    const CurveSkeleton none = with(Refinement::None), hull = with(Refinement::Hull),
                        surface = with(Refinement::Surface);
    check_same_topology(none, hull);
    check_same_topology(none, surface);
    CHECK(fault_of(surface).empty());
    CHECK(distances(surface, made.truth).mean < distances(hull, made.truth).mean);
    for (const auto& n : hull.nodes) CHECK(n.section_radius == 0);
    for (const auto& n : surface.nodes) CHECK(n.section_radius >= n.radius);
  }
}

TEST_CASE("clouds and volumes have no surface and keep the radii of the hull", "[refinement]") {
  const Shape tube_points{tube(-1, 1, 0.25).points, {}};
  ExtractOptions options;
  options.image_resolution = 96;
  options.grid_resolution = 48;
  const CurveSkeleton surface = extract(tube_points, options);
  options.refinement = Refinement::Hull;
  CHECK(extract(tube_points, options) == surface);
}
