#include "picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marrow {
namespace {

// A box in the principal frame has to be this much smaller than in the input axes to be preferred.
constexpr double kTighter = 0.6;
constexpr double kFilled = 0.86;  // of a cell
constexpr double kClearlyLarger = 1.3;
constexpr double kMaxEnlarged = 1.5;  // of a view over the one with the smallest scale

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = -low;

  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3 center() const { return (low + high) * 0.5; }
  Vec3 size() const { return high - low; }
};

Box box_along(const Frame& axes, std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) box.add(to_frame(axes, p));
  return box;
}

/// Area of the box's surface: unlike the volume it still tells flat things apart.
double surface(const Box& box) {
  const Vec3 s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

std::array<double, 3> parts(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Index of the greatest component, in magnitude.
std::size_t main_axis(const Vec3& v) {
  const std::array<double, 3> a = {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
  if (a[0] >= a[1] && a[0] >= a[2]) return 0;
  return a[1] >= a[2] ? 1 : 2;
}

Vec3 pointing_forward(const Vec3& v) { return parts(v)[main_axis(v)] < 0 ? -v : v; }

/// Turns `axes` so that z is the shortest side of the box and y its upward side. Nothing in a file
/// says what is up: x never is; of y and z the shorter one is, as animals are longer than tall.
Frame posed(const Frame& axes, const Box& box) {
  struct Side {
    Vec3 axis;
    double size;
  };
  std::array<Side, 3> sides = {Side{axes.x, box.size().x}, Side{axes.y, box.size().y},
                               Side{axes.z, box.size().z}};
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return a.size > b.size; });
  const bool second_is_x = main_axis(sides[1].axis) == 0;
  const Vec3 up = pointing_forward(second_is_x ? sides[0].axis : sides[1].axis);
  const Vec3 right = pointing_forward(second_is_x ? sides[1].axis : sides[0].axis);
  return {right, up, cross(right, up)};
}

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
}

/// The axes whose box is the better one; `points` are prescaled.
Frame framing_axes(const Shape& shape, std::span<const Vec3> points) {
  const Frame input;
  if (shape.triangles.empty()) return input;
  const Vec3 size = box_along(input, points).size();
  if (std::max({size.x, size.y, size.z}) <= 0) return input;
  const Frame principal = normalize(shape).axes;
  const double ratio = surface(box_along(principal, points)) / surface(box_along(input, points));
  return ratio < kTighter ? principal : input;
}

struct Axes {
  std::string_view name;
  Vec3 right, up, toward;
};

// Three-quarter: 35 degrees to the right, 22 degrees from above.
constexpr double kSinAround = 0.5735764363510461, kCosAround = 0.8191520442889918;
constexpr double kSinAbove = 0.3746065934159120, kCosAbove = 0.9271838545667874;

// In the order of ViewChoice.
constexpr std::array<Axes, 4> kAxes = {
    Axes{"front", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Axes{"side", {0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
    Axes{"top", {1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    Axes{"three-quarter",
         {kCosAround, 0, -kSinAround},
         {-kSinAround * kSinAbove, kCosAbove, -kCosAround* kSinAbove},
         {kSinAround * kCosAbove, kSinAbove, kCosAround* kCosAbove}}};

/// Pixels per unit at which `size` fills its share of the cell.
double fitting_scale(const Vec3& size, const Rect& cell) {
  const double smallest = 1e-6;
  return kFilled * std::min(cell.width / std::max(size.x, smallest),
                            cell.height / std::max(size.y, smallest));
}

using Cells = std::array<Rect, 4>;

Cells divide(const Rect& area, int columns, int rows) {
  Cells cells;
  for (int i = 0; i < 4; ++i) {
    const int column = i % columns;
    const int row = i / columns;
    const int left = area.left + area.width * column / columns;
    const int top = area.top + area.height * row / rows;
    cells[static_cast<std::size_t>(i)] = {left, top,
                                          area.left + area.width * (column + 1) / columns - left,
                                          area.top + area.height * (row + 1) / rows - top};
  }
  return cells;
}

std::array<double, 4> scales_of(const std::array<Box, 4>& boxes, const Cells& cells) {
  std::array<double, 4> scales{};
  for (std::size_t i = 0; i < 4; ++i) scales[i] = fitting_scale(boxes[i].size(), cells[i]);
  const double limit = kMaxEnlarged * *std::min_element(scales.begin(), scales.end());
  for (double& scale : scales) scale = std::min(scale, limit);
  return scales;
}

/// The view along `axes` with the middle of the box in that of the cell.
View framed(const Axes& axes, const Box& box, const Rect& cell, double scale) {
  const Vec3 center = box.center();
  View view{axes.name, axes.right, axes.up, axes.toward, cell, scale, 0, 0};
  view.origin_x = cell.left + 0.5 * cell.width - scale * center.x;
  view.origin_y = cell.top + 0.5 * cell.height + scale * center.y;
  return view;
}

}  // namespace

std::vector<Vec3> drawn_points(const Shape& shape) {
  if (shape.triangles.empty()) return shape.points;
  std::vector<bool> used(shape.points.size(), false);
  for (const Triangle& t : shape.triangles) {
    for (const std::uint32_t i : t) used[i] = true;
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    if (used[i]) points.push_back(shape.points[i]);
  }
  return points;
}

Normalization pose_of(const Shape& shape, const CurveSkeleton& skeleton) {
  std::vector<Vec3> points = drawn_points(shape);
  if (points.empty()) {
    for (const auto& node : skeleton.nodes) points.push_back(node.position);
  }
  Normalization pose;
  if (points.empty()) return pose;

  // A power of two before anything else: no product of coordinates may overflow.
  const double largest = largest_coordinate(points);
  if (largest > 0) {
    pose.prescale = std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1020, 1020));
  }
  for (Vec3& p : points) p = p * pose.prescale;
  const Frame axes = framing_axes(shape, points);
  pose.axes = posed(axes, box_along(axes, points));
  const Box box = box_along(pose.axes, points);
  pose.center = from_frame(pose.axes, box.center());
  pose.radius = length(box.size()) * 0.5;
  if (!(pose.radius > 0)) pose.radius = 1;
  return pose;
}

Vec3 place(const Normalization& pose, const Vec3& p) {
  const auto within = [](const Vec3& v, double limit) {
    return Vec3{std::clamp(v.x, -limit, limit), std::clamp(v.y, -limit, limit),
                std::clamp(v.z, -limit, limit)};
  };
  const Vec3 finite = within(p * pose.prescale, 1e100);  // no infinity may meet a zero of the axes
  return within(to_frame(pose.axes, finite - pose.center) / pose.radius, 1000);
}

std::vector<View> views_of(std::span<const Vec3> points, const Rect& area, ViewChoice choice) {
  std::array<Box, 4> boxes;
  for (std::size_t i = 0; i < 4; ++i) {
    const Frame axes{kAxes[i].right, kAxes[i].up, kAxes[i].toward};
    boxes[i] = points.empty() ? Box{{}, {}} : box_along(axes, points);
  }
  if (choice != ViewChoice::All) {
    const auto i = static_cast<std::size_t>(choice);
    return {framed(kAxes[i], boxes[i], area, fitting_scale(boxes[i].size(), area))};
  }
  const Cells square = divide(area, 2, 2);
  const Cells strip = divide(area, 4, 1);
  const bool upright = scales_of(boxes, strip)[0] > kClearlyLarger * scales_of(boxes, square)[0];
  const Cells& cells = upright ? strip : square;
  const std::array<double, 4> scales = scales_of(boxes, cells);
  std::vector<View> views;
  for (std::size_t i = 0; i < 4; ++i)
    views.push_back(framed(kAxes[i], boxes[i], cells[i], scales[i]));
  return views;
}

}  // namespace marrow
