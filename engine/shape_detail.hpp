// What the readers and writers of shapes share.
#pragma once

#include <marrow/shape.hpp>
#include <marrow/shape_io.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace marrow::shape_detail {

/// A file to be read: what is in it, and how messages call it.
struct Source {
  std::string_view bytes;
  std::string name;
  ReadOptions options;
};

// One pair per format. Readers throw Error: Malformed, Unsupported, Empty, Limit; writers throw
// Unsupported and Limit where the format cannot hold the shape.
Shape parse_obj(const Source& source);
Shape parse_ply(const Source& source);
Shape parse_stl(const Source& source);
Shape parse_off(const Source& source);
Shape parse_xyz(const Source& source);
Shape parse_pcd(const Source& source);  // is not written
std::string format_obj(const Shape& shape);
std::string format_ply(const Shape& shape);
std::string format_stl(const Shape& shape);
std::string format_off(const Shape& shape);
std::string format_xyz(const Shape& shape);

/// True if a line begins with three numbers.
bool looks_like_xyz(std::string_view line);

/// True if the bytes are as many as a binary STL of its count of triangles has.
bool is_binary_stl(std::string_view bytes);

/// Gathers points and faces, and makes a shape of them.
class ShapeBuilder {
 public:
  /// `place` goes before the number of a point in messages: "" for lines, "vertex " for rows.
  ShapeBuilder(const Source& source, std::string place);

  void reserve(std::size_t points, std::size_t triangles);

  /// `number` is the line or the row of the point, for messages.
  void add_point(const Vec3& point, std::uint64_t number) {
    // Zero unless a coordinate is infinite or not a number.
    const double test = (point.x - point.x) + (point.y - point.y) + (point.z - point.z);
    if (!(test == 0)) not_finite_.push_back({points_.size(), number});
    points_.push_back(point);
  }

  void add_triangle(const Triangle& triangle) {
    if (triangles_left_ == 0) too_many_triangles();
    --triangles_left_;
    triangles_.push_back(triangle);
  }

  /// A face with any number of corners; with fewer than three it covers nothing and is passed over.
  /// The indices have been checked.
  void add_face(std::span<const std::uint32_t> corners);

  std::size_t point_count() const { return points_.size(); }
  const std::vector<Vec3>& points() const { return points_; }

  /// Throws Error: Empty (nothing at all), Malformed (a face uses a point that is not finite).
  Shape finish() &&;

 private:
  struct NotFinite {
    std::size_t point;
    std::uint64_t number;
  };
  /// Its corners begin at `first_corner`; it comes before the triangle `before`.
  struct Polygon {
    std::size_t before, first_corner, corner_count;
  };

  [[noreturn]] void too_many_triangles() const;
  void check_points();
  void cut_polygons();
  void cut(std::span<const std::uint32_t> corners, std::span<const Vec3> places,
           std::vector<Triangle>& triangles);

  std::string name_, place_;
  std::uint64_t max_triangles_, triangles_left_;
  std::vector<Vec3> points_;
  std::vector<NotFinite> not_finite_;
  std::vector<Triangle> triangles_;
  std::vector<Polygon> polygons_;
  std::vector<std::uint32_t> corners_;  // of all polygons
};

}  // namespace marrow::shape_detail
