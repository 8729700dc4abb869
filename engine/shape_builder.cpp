#include <marrow/error.hpp>
#include <marrow/polygon.hpp>

#include <cmath>
#include <utility>

#include "polygon_detail.hpp"
#include "shape_detail.hpp"
#include "text_detail.hpp"

namespace marrow::shape_detail {

namespace {

std::string coordinates(const Vec3& p) {
  std::string text;
  for (const double x : {p.x, p.y, p.z}) {
    if (!text.empty()) text += ' ';
    text_detail::append(text, x);
  }
  return text;
}

}  // namespace

ShapeBuilder::ShapeBuilder(const Source& source, std::string place)
    : name_(source.name),
      place_(std::move(place)),
      max_triangles_(source.options.max_triangles),
      triangles_left_(source.options.max_triangles) {}

void ShapeBuilder::reserve(std::size_t points, std::size_t triangles) {
  points_.reserve(points);
  triangles_.reserve(triangles);
}

void ShapeBuilder::add_face(std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) return add_triangle({corners[0], corners[1], corners[2]});
  if (triangles_left_ < corners.size() - 2) too_many_triangles();
  triangles_left_ -= corners.size() - 2;
  polygons_.push_back({triangles_.size(), corners_.size(), corners.size()});
  corners_.insert(corners_.end(), corners.begin(), corners.end());
}

Shape ShapeBuilder::finish() && {
  if (points_.empty())
    text_detail::fail(ErrorKind::Empty, name_, "",
                      "holds no points and no faces; there is nothing to read");
  check_points();
  cut_polygons();
  return {std::move(points_), std::move(triangles_)};
}

void ShapeBuilder::too_many_triangles() const {
  text_detail::fail(ErrorKind::Limit, name_, "",
                    "holds more triangles than the limit of " + std::to_string(max_triangles_) +
                        "; raise the limit or simplify the shape");
}

/// Points that are not finite are an error where they count: in a face, or if there is no face.
/// Else they go to the origin, so that all coordinates of a shape are finite.
void ShapeBuilder::check_points() {
  if (not_finite_.empty()) return;
  const bool all_count = triangles_.empty() && polygons_.empty();
  std::vector<bool> counts(points_.size(), all_count);
  for (const Triangle& t : triangles_)
    for (const std::uint32_t i : t) counts[i] = true;
  for (const std::uint32_t i : corners_) counts[i] = true;
  for (const auto& [point, number] : not_finite_) {
    if (counts[point])
      text_detail::fail(ErrorKind::Malformed, name_, place_ + std::to_string(number),
                        "the coordinates " + coordinates(points_[point]) +
                            " are not finite; repair or remove the vertex");
    points_[point] = {};
  }
}

void ShapeBuilder::cut_polygons() {
  if (polygons_.empty()) return;
  std::vector<Triangle> all;
  all.reserve(triangles_.size() + corners_.size() - 2 * polygons_.size());
  auto next = triangles_.begin();
  std::vector<Vec3> places;
  for (const auto& [before, first_corner, corner_count] : polygons_) {
    const auto end = triangles_.begin() + static_cast<std::ptrdiff_t>(before);
    all.insert(all.end(), next, end);
    next = end;
    const std::span<const std::uint32_t> corners(corners_.data() + first_corner, corner_count);
    places.clear();
    for (const std::uint32_t i : corners) places.push_back(points_[i]);
    cut(corners, places, all);
    // A polygon that crosses itself gives more triangles than it has corners.
    if (all.size() > max_triangles_) too_many_triangles();
  }
  all.insert(all.end(), next, triangles_.end());
  triangles_ = std::move(all);
}

void ShapeBuilder::cut(std::span<const std::uint32_t> corners, std::span<const Vec3> places,
                       std::vector<Triangle>& triangles) {
  const std::size_t n = corners.size();
  if (const auto apex = polygon_detail::fan_apex(places)) {
    for (std::size_t i = 1; i + 1 < n; ++i)
      triangles.push_back({corners[*apex], corners[(*apex + i) % n], corners[(*apex + i + 1) % n]});
    return;
  }
  const PolygonCut result = cut_polygon(places);
  const auto first_extra = points_.size();
  points_.insert(points_.end(), result.extra_points.begin(), result.extra_points.end());
  for (Triangle t : result.triangles) {
    for (std::uint32_t& i : t)
      i = i < n ? corners[i] : static_cast<std::uint32_t>(first_extra + i - n);
    triangles.push_back(t);
  }
}

}  // namespace marrow::shape_detail
