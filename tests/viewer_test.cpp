#include <analytic_shapes.hpp>
#include <viewer/base64.hpp>
#include <viewer/coarse_shape.hpp>
#include <viewer/view_page.hpp>

#include <algorithm>
#include <set>

#include "catch.hpp"

using namespace marrow;

namespace {

/// The points of a shape from -1 to 1.
std::vector<Vec3> places_of(const Shape& shape) {
  double most = 0;
  for (const Vec3& p : shape.points)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  std::vector<Vec3> places;
  for (const Vec3& p : shape.points) places.push_back(p / most);
  return places;
}

std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    ++count;
  return count;
}

}  // namespace

TEST_CASE("base64 is that of RFC 4648", "[viewer]") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\xfe\x00", 3)) == "//4A");
}

TEST_CASE("a shape for which there is room is shown as it is", "[viewer]") {
  const Shape shape = make_analytic_shape("y", {0.5}).shape;
  const std::vector<Vec3> places = places_of(shape);
  const CoarseShape coarse = coarsened(places, shape.triangles);
  CHECK(coarse.points.size() == shape.points.size());
  CHECK(coarse.triangles.size() == shape.triangles.size());
  for (std::size_t i = 0; i < coarse.points.size(); ++i) {
    const Vec3& p = places[coarse.source[i]];
    const auto& [x, y, z] = coarse.points[i];
    const Vec3 shown = Vec3{double(x), double(y), double(z)} * (2 / 65535.0) - Vec3{1, 1, 1};
    REQUIRE(distance(shown, p) < 3 / 65535.0);
  }
}

TEST_CASE("a larger shape is shown coarser, as large as there is room", "[viewer]") {
  const Shape shape = make_analytic_shape("quadruped").shape;
  const std::vector<Vec3> places = places_of(shape);
  const PageRoom room{3000, 5000};
  const CoarseShape coarse = coarsened(places, shape.triangles, room);
  CHECK(coarse.points.size() <= room.points);
  CHECK(coarse.triangles.size() <= room.triangles);
  CHECK(coarse.triangles.size() > room.triangles / 2);
  std::set<std::uint16_t> used;
  for (const auto& t : coarse.triangles) used.insert(t.begin(), t.end());
  CHECK(used.size() == coarse.points.size());
  CHECK(*used.rbegin() + 1U == coarse.points.size());
  const CoarseShape cloud = coarsened(places, {}, room);
  CHECK(cloud.points.size() <= room.points);
  CHECK(cloud.points.size() > room.points / 2);
}

TEST_CASE("points that no triangle uses are not shown", "[viewer]") {
  const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0.5}, {0, 1, 0}, {0, 1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 3}, {1, 4, 0}, {3, 3, 4}, {0, 3, 1}};
  const CoarseShape coarse = coarsened(places, triangles);
  CHECK(coarse.points.size() == 3);
  CHECK(coarse.triangles.size() == 2);  // one from either side
}

TEST_CASE("a page shows names as they are and is whole", "[viewer]") {
  AnalyticShape made = make_analytic_shape("y", {0.5});
  const std::string hostile = "</script><script>alert(1)</script> @DATA@ & \"\xff\n";
  const std::string page = view_page({hostile, made.shape, {{hostile, made.truth}}});
  CHECK(count_of(page, "<script") == 2);
  CHECK(count_of(page, "</script>") == 2);
  CHECK(count_of(page, "\\u003c/script>\\u003cscript>alert(1)") == 1);
  CHECK(count_of(page, "&lt;/script&gt;&lt;script&gt;alert(1)") == 2);
  CHECK(count_of(page, "@DATA@") == 3);  // in the title, the heading and a name
  CHECK(page.find("http") == page.find("http-equiv"));
  CHECK(count_of(page, "http") == 1);
  CHECK(page == view_page({hostile, made.shape, {{hostile, made.truth}}}));
}

TEST_CASE("legal shapes and lines of every kind have a page", "[viewer]") {
  const CurveSkeleton dot{{{{0, 0, 0}, 1}}, {}};
  const Shape triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const Shape& shape : {Shape{}, triangle, Shape{{{1, 2, 3}}, {}}})
    for (const CurveSkeleton& skeleton : {CurveSkeleton{}, dot}) {
      CHECK(count_of(view_page({"", shape, {{"", skeleton}}}), "</html>") == 1);
      CHECK(count_of(view_page({"", shape, {}}), "</html>") == 1);
    }
}
