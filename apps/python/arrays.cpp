#include "arrays.hpp"

#include <marrow/error.hpp>
#include <marrow/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace py = pybind11;

namespace marrow {

namespace {

[[noreturn]] void refuse(ErrorKind kind, const std::string& words) { throw Error(kind, words); }

std::string shape_words(const py::array& array) {
  std::string words = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    words += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return words + ")";
}

void check_rows(const py::array& array, py::ssize_t columns, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == columns) return;
  refuse(ErrorKind::Usage, std::string(name) + " must be an array of n x " +
                               std::to_string(columns) + ", not of " + shape_words(array));
}

std::vector<Vec3> points_of(const Doubles& rows) {
  std::vector<Vec3> points(static_cast<std::size_t>(rows.shape(0)));
  const auto at = rows.unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    points[i] = {at(row, 0), at(row, 1), at(row, 2)};
  }
  return points;
}

std::uint32_t index_in(std::int64_t index, std::size_t count, const char* name, py::ssize_t row) {
  if (index < 0 || static_cast<std::size_t>(index) >= count)
    refuse(ErrorKind::Malformed, std::string(name) + "[" + std::to_string(row) + "]: index " +
                                     std::to_string(index) + " is out of range 0.." +
                                     std::to_string(static_cast<std::int64_t>(count) - 1));
  return static_cast<std::uint32_t>(index);
}

void check_count(std::size_t count, const char* name) {
  if (count > std::numeric_limits<std::uint32_t>::max())
    refuse(ErrorKind::Limit, std::string(name) + ": more than 4294967295 rows; use fewer");
}

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Points that count must be finite; the others become 0.
void check_points(Shape& shape, const std::vector<bool>& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (is_finite(shape.points[i])) continue;
    if (counts[i])
      refuse(ErrorKind::Malformed,
             "vertices[" + std::to_string(i) + "] is not finite; repair or remove the vertex");
    shape.points[i] = {};
  }
}

void add_polygon(Shape& shape, const std::vector<std::uint32_t>& corners) {
  std::vector<Vec3> places;
  for (const std::uint32_t i : corners) places.push_back(shape.points[i]);
  const PolygonCut cut = cut_polygon(places);
  const std::size_t first_extra = shape.points.size();
  shape.points.insert(shape.points.end(), cut.extra_points.begin(), cut.extra_points.end());
  for (Triangle t : cut.triangles) {
    for (std::uint32_t& i : t)
      i = i < corners.size() ? corners[i]
                             : static_cast<std::uint32_t>(first_extra + i - corners.size());
    shape.triangles.push_back(t);
  }
}

void add_faces(Shape& shape, const Indices& faces) {
  if (faces.ndim() != 2 || faces.shape(1) < 3)
    refuse(ErrorKind::Usage,
           "faces must be an array of m x 3 (or more corners), not of " + shape_words(faces));
  const auto at = faces.unchecked<2>();
  const auto corners = static_cast<std::size_t>(faces.shape(1));
  const std::size_t count = shape.points.size();
  std::vector<std::uint32_t> all;
  all.reserve(static_cast<std::size_t>(faces.size()));
  std::vector<bool> counts(count);
  for (py::ssize_t row = 0; row < faces.shape(0); ++row)
    for (py::ssize_t k = 0; k < faces.shape(1); ++k) {
      all.push_back(index_in(at(row, k), count, "faces", row));
      counts[all.back()] = true;
    }
  check_points(shape, counts);
  shape.triangles.reserve(all.size() / corners * (corners - 2));
  for (auto face = all.begin(); face != all.end(); face += static_cast<std::ptrdiff_t>(corners))
    if (corners == 3)
      shape.triangles.push_back({face[0], face[1], face[2]});
    else
      add_polygon(shape, {face, face + static_cast<std::ptrdiff_t>(corners)});
}

int side_of(const py::array& values, py::ssize_t axis) {
  const py::ssize_t side = values.shape(axis);
  if (side < 1) refuse(ErrorKind::Usage, "the volume has no voxels");
  if (side > Volume::kLongestSide)
    refuse(ErrorKind::Limit, "the volume has more than " + std::to_string(Volume::kLongestSide) +
                                 " voxels along axis " + std::to_string(axis));
  return static_cast<int>(side);
}

/// Sets the voxels of `volume` whose `Value` is greater than `iso`.
template <class Value>
void set_above(Volume& volume, const py::array& values, double iso) {
  const auto* begin = static_cast<const char*>(values.data());
  const py::ssize_t* strides = values.strides();
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y) {
      const char* row = begin + y * strides[1] + z * strides[2];
      for (int x = 0; x < volume.nx; ++x) {
        Value value;
        std::copy_n(row + x * strides[0], sizeof value, reinterpret_cast<char*>(&value));
        if (static_cast<double>(value) > iso) volume.set(x, y, z);
      }
    }
}

/// Calls set_above() for the first of these types that `values` are of.
template <class First, class... Others>
void set_above_of(Volume& volume, const py::array& values, double iso) {
  if (py::isinstance<py::array_t<First>>(values)) return set_above<First>(volume, values, iso);
  if constexpr (sizeof...(Others) > 0)
    set_above_of<Others...>(volume, values, iso);
  else
    refuse(ErrorKind::Unsupported,
           "values of type " + py::cast<std::string>(py::str(values.dtype())) +
               "; use whole or real numbers in the byte order of the machine");
}

}  // namespace

Shape shape_of(const Doubles& vertices, const Indices* faces) {
  check_rows(vertices, 3, faces ? "vertices" : "points");
  Shape shape;
  shape.points = points_of(vertices);
  check_count(shape.points.size(), "vertices");
  if (!faces) check_points(shape, std::vector<bool>(shape.points.size(), true));
  if (faces) add_faces(shape, *faces);
  if (faces && shape.triangles.empty()) refuse(ErrorKind::Empty, "there are no faces");
  return shape;
}

Volume volume_of(const py::array& values, double iso, const Vec3& spacing, const Vec3& origin) {
  if (values.ndim() != 3)
    refuse(ErrorKind::Usage,
           "a volume must be an array of three axes, not of " + shape_words(values));
  for (const double s : {spacing.x, spacing.y, spacing.z})
    if (!(s > 0) || !std::isfinite(s))
      refuse(ErrorKind::Usage, "the spacing must be greater than 0 along every axis");
  Volume volume(side_of(values, 0), side_of(values, 1), side_of(values, 2));
  volume.origin = origin;
  volume.steps = {Vec3{spacing.x, 0, 0}, Vec3{0, spacing.y, 0}, Vec3{0, 0, spacing.z}};
  set_above_of<bool, std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
               std::int32_t, std::uint64_t, std::int64_t, float, double>(volume, values, iso);
  return volume;
}

CurveSkeleton skeleton_of(const Doubles& nodes, const Doubles& radii, const Indices& edges,
                          const Doubles* section_radii) {
  check_rows(nodes, 3, "nodes");
  check_rows(edges, 2, "edges");
  const auto check_length = [&](const Doubles& column, const char* name) {
    if (column.ndim() != 1 || column.shape(0) != nodes.shape(0))
      refuse(ErrorKind::Usage, std::string(name) + " must have one value for each node");
  };
  check_length(radii, "radii");
  if (section_radii) check_length(*section_radii, "section_radii");
  const std::vector<Vec3> places = points_of(nodes);
  check_count(places.size(), "nodes");
  CurveSkeleton skeleton;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    const double section = section_radii ? section_radii->at(row) : 0;
    skeleton.nodes.push_back({places[i], radii.at(row), section});
    const auto& node = skeleton.nodes.back();
    const bool is_right = is_finite(node.position) && node.radius > 0 &&
                          std::isfinite(node.radius) && std::isfinite(section) && section >= 0;
    if (!is_right)
      refuse(ErrorKind::Malformed,
             "node " + std::to_string(i) + ": positions and radii must be finite, radii > 0");
  }
  const auto at = edges.unchecked<2>();
  for (py::ssize_t row = 0; row < edges.shape(0); ++row) {
    const NodeId a = index_in(at(row, 0), places.size(), "edges", row);
    const NodeId b = index_in(at(row, 1), places.size(), "edges", row);
    if (a == b)
      refuse(ErrorKind::Malformed, "edges[" + std::to_string(row) + "] joins a node to itself");
    skeleton.edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(skeleton.edges.begin(), skeleton.edges.end());
  skeleton.edges.erase(std::unique(skeleton.edges.begin(), skeleton.edges.end()),
                       skeleton.edges.end());
  return skeleton;
}

}  // namespace marrow
