#include "flat_mesh.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace marrow {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A grid of equilateral triangles, clipped by the outline.
class FlatMesher {
 public:
  FlatMesher(const Field& field, const Box& box, double cell)
      : field_(field),
        cell_(cell),
        low_(box.low),
        columns_(static_cast<int>(std::ceil((box.high.x - box.low.x) / cell)) + 3),
        rows_(static_cast<int>(std::ceil((box.high.y - box.low.y) / row_height())) + 3) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) add_corner(row, column);
    }
    ids_.assign(corners_.size(), kNone);
    for (int row = 0; row + 1 < rows_; ++row) {
      for (int column = 0; column + 1 < columns_; ++column) add_cell(row, column);
    }
  }

  Shape finish() { return std::move(shape_); }

 private:
  struct Corner {
    Vec3 place;
    double value;
  };

  double row_height() const { return cell_ * 0.8660254037844386; }
  int corner_at(int row, int column) const { return row * columns_ + column; }

  /// Corners next to the outline are pulled onto it, so that no clipped triangle is a sliver.
  void add_corner(int row, int column) {
    const double shift = row % 2 == 1 ? 0.5 : 0;
    Vec3 p{low_.x + (column - 1 + shift) * cell_, low_.y + (row - 1) * row_height(), 0};
    double value = field_.value(p);
    if (std::abs(value) < 0.3 * cell_) {
      for (int i = 0; i < 3; ++i) {
        const auto [here, slope] = field_.sample(p);
        const double steepness = slope.x * slope.x + slope.y * slope.y;
        if (steepness < 1e-6) break;
        p += Vec3{slope.x, slope.y, 0} * (-here / steepness);
      }
      value = 0;
    }
    corners_.push_back({p, value});
  }

  void add_cell(int row, int column) {
    const int a = corner_at(row, column);
    const int b = corner_at(row, column + 1);
    const int c = corner_at(row + 1, column);
    const int d = corner_at(row + 1, column + 1);
    if (row % 2 == 0) {
      add_triangle({a, b, c});
      add_triangle({b, d, c});
    } else {
      add_triangle({a, d, c});
      add_triangle({a, b, d});
    }
  }

  const Corner& corner(int i) const { return corners_[static_cast<std::size_t>(i)]; }

  /// Keeps the part of a triangle that lies inside: at most four corners.
  void add_triangle(const std::array<int, 3>& triangle) {
    bool has_inside = false;
    for (const int i : triangle) has_inside = has_inside || corner(i).value < 0;
    if (!has_inside) return;
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangle[i];
      const int b = triangle[(i + 1) % 3];
      if (corner(a).value <= 0) polygon.push_back(point_at(a));
      if (corner(a).value * corner(b).value < 0) polygon.push_back(point_between(a, b));
    }
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      shape_.triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
    }
  }

  std::uint32_t point_at(int i) {
    std::uint32_t& id = ids_[static_cast<std::size_t>(i)];
    if (id == kNone) {
      id = static_cast<std::uint32_t>(shape_.points.size());
      shape_.points.push_back(corner(i).place);
    }
    return id;
  }

  std::uint32_t point_between(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [found, is_new] =
        between_.try_emplace({a, b}, static_cast<std::uint32_t>(shape_.points.size()));
    if (is_new) shape_.points.push_back(crossing(corner(a), corner(b)));
    return found->second;
  }

  Vec3 crossing(const Corner& a, const Corner& b) const {
    double low = 0;
    double high = 1;
    for (int i = 0; i < 40; ++i) {
      const double middle = (low + high) / 2;
      const double value = field_.value(a.place + (b.place - a.place) * middle);
      ((value < 0) == (a.value < 0) ? low : high) = middle;
    }
    return a.place + (b.place - a.place) * low;
  }

  const Field& field_;
  double cell_;
  Vec3 low_;
  int columns_, rows_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> ids_;
  std::map<std::pair<int, int>, std::uint32_t> between_;
  Shape shape_;
};

}  // namespace

Shape fill_flat(const Field& field, const Box& box, double cell) {
  return FlatMesher(field, box, cell).finish();
}

}  // namespace marrow
