#include <marrow/distance_transform.hpp>
#include <marrow/silhouette.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace marrow {

namespace {

constexpr double kSmallHole = 0.02;  // inscribed radius, in sides of the image

/// Half plane a * x + c >= 0 along one row; x in pixels.
struct EdgeOnRow {
  std::int64_t a = 0, c = 0;
};

/// A triangle on the lattice, counter-clockwise, with its pixel box.
class LatticeTriangle {
 public:
  LatticeTriangle(const SnappedPoints& p, const Triangle& t, int shift) {
    for (std::size_t i = 0; i < 3; ++i) x_[i] = p.x(t[i]), y_[i] = p.y(t[i]);
    const int round_up = (1 << shift) - 1;
    left = (std::min({x_[0], x_[1], x_[2]}) + round_up) >> shift;
    right = std::max({x_[0], x_[1], x_[2]}) >> shift;
    low = (std::min({y_[0], y_[1], y_[2]}) + round_up) >> shift;
    high = std::max({y_[0], y_[1], y_[2]}) >> shift;
  }

  bool misses_all_centres() const { return left > right || low > high; }

  std::int64_t twice_area() const {
    return std::int64_t{x_[1] - x_[0]} * (y_[2] - y_[0]) -
           std::int64_t{x_[2] - x_[0]} * (y_[1] - y_[0]);
  }

  void orient() {
    if (twice_area() < 0) std::swap(x_[1], x_[2]), std::swap(y_[1], y_[2]);
  }

  /// The edge functions on pixel row `row`.
  std::array<EdgeOnRow, 3> edges_on_row(int row, int shift) const {
    std::array<EdgeOnRow, 3> e;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::int64_t dx = x_[j] - x_[i], dy = y_[j] - y_[i];
      // dx * (Y - y) - dy * (X - x) >= 0
      e[i].a = -dy * (1 << shift);
      e[i].c = dx * ((std::int64_t{row} << shift) - y_[i]) + dy * x_[i];
    }
    return e;
  }

  int left, right, low, high;

 private:
  std::array<int, 3> x_, y_;
};

void set_span(BitImage::Word* row, int left, int right) {
  const int first = left >> 6, last = right >> 6;
  const BitImage::Word from = ~BitImage::Word{0} << (left & 63);
  const BitImage::Word to = ~BitImage::Word{0} >> (63 - (right & 63));
  if (first == last) {
    row[first] |= from & to;
    return;
  }
  row[first] |= from;
  for (int i = first + 1; i < last; ++i) row[i] = ~BitImage::Word{0};
  row[last] |= to;
}

/// Floor of c / d; exact in double because both are integers far below 2^53 and d < 2^24.
int floor_div(std::int64_t c, std::int64_t d) {
  return static_cast<int>(std::floor(static_cast<double>(c) / static_cast<double>(d)));
}

void fill_row(BitImage& mask, const LatticeTriangle& t, int y, int shift) {
  int left = t.left, right = t.right;
  for (const auto& e : t.edges_on_row(y, shift)) {
    if (e.a > 0)
      left = std::max(left, -floor_div(e.c, e.a));
    else if (e.a < 0)
      right = std::min(right, floor_div(e.c, -e.a));
    else if (e.c < 0)
      return;
  }
  if (left <= right) set_span(mask.row(y), left, right);
}

void fill_triangle(BitImage& mask, LatticeTriangle& t, int shift) {
  t.orient();
  if (t.left == t.right && t.low == t.high) {
    if (mask(t.left, t.low)) return;
    const auto edges = t.edges_on_row(t.low, shift);
    if (std::all_of(edges.begin(), edges.end(),
                    [&](const EdgeOnRow& e) { return e.a * t.left + e.c >= 0; }))
      mask.set(t.left, t.low);
    return;
  }
  for (int y = t.low; y <= t.high; ++y) fill_row(mask, t, y, shift);
}

int nearest_pixel(int coordinate, int shift) { return (coordinate + (1 << shift) / 2) >> shift; }

/// Sets the pixels along an edge that `near_mask` does not hold; the order of its ends is nothing.
void trace_edge(BitImage& trace, const BitImage& near_mask, int x0, int y0, int x1, int y1,
                int shift) {
  if (std::pair(x1, y1) < std::pair(x0, y0)) std::swap(x0, x1), std::swap(y0, y1);
  const int steps = (std::max(std::abs(x1 - x0), std::abs(y1 - y0)) >> shift) + 1;
  for (int i = 0; i <= steps; ++i) {
    const int x = nearest_pixel(x0 + (x1 - x0) * i / steps, shift);
    const int y = nearest_pixel(y0 + (y1 - y0) * i / steps, shift);
    if (!near_mask(x, y)) trace.set(x, y);
  }
}

/// For every point, whether its pixel is not covered by `near_mask`; empty when all are.
std::vector<std::uint8_t> uncovered_points(const SnappedPoints& points, const BitImage& near_mask,
                                           int shift) {
  std::vector<std::uint8_t> uncovered(points.size());
  bool any = false;
  for (std::size_t i = 0; i < uncovered.size(); ++i) {
    uncovered[i] = !near_mask(nearest_pixel(points.x(i), shift), nearest_pixel(points.y(i), shift));
    any |= uncovered[i] != 0;
  }
  if (!any) uncovered.clear();
  return uncovered;
}

}  // namespace

BitImage fill_triangles(const SnappedPoints& points, std::span<const Triangle> triangles,
                        int resolution) {
  const int shift = std::countr_zero(static_cast<unsigned>(subpixels_of(resolution)));
  BitImage mask(resolution, resolution);
  for (const auto& corners : triangles) {
    LatticeTriangle t(points, corners, shift);
    if (!t.misses_all_centres()) fill_triangle(mask, t, shift);
  }
  return mask;
}

void trace_thin_triangles(BitImage& mask, const SnappedPoints& points,
                          std::span<const Triangle> triangles, int resolution) {
  const int shift = std::countr_zero(static_cast<unsigned>(subpixels_of(resolution)));
  const BitImage near_mask = dilate(mask, 1.5);
  const auto uncovered = uncovered_points(points, near_mask, shift);
  const std::int64_t thin = std::int64_t{8} << (2 * shift);
  BitImage trace(resolution, resolution);
  for (const auto& t : triangles) {
    const LatticeTriangle box(points, t, shift);
    // The edges of a small triangle stay within a pixel of its corners.
    const bool small = box.right - box.left < 2 && box.high - box.low < 2;
    const bool seen = !uncovered.empty() && (uncovered[t[0]] | uncovered[t[1]] | uncovered[t[2]]);
    if ((small && !seen) || std::abs(box.twice_area()) >= thin) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      trace_edge(trace, near_mask, points.x(a), points.y(a), points.x(b), points.y(b), shift);
    }
  }
  for (int y = 0; y < resolution; ++y)
    for (int i = 0; i < mask.words_per_row(); ++i) mask.row(y)[i] |= trace.row(y)[i];
}

void fill_small_holes(BitImage& mask, double radius) {
  const int width = mask.width(), height = mask.height();
  const BitImage background = complement(mask);
  const DistanceMap depth = distance_transform(background);
  BitImage open = background;  // not yet visited
  std::vector<std::pair<int, int>> part;
  for (int y0 = 0; y0 < height; ++y0)
    for (int x0 = 0; x0 < width; ++x0) {
      if (!open(x0, y0)) continue;
      part.assign(1, {x0, y0});
      open.clear(x0, y0);
      bool enclosed = true;
      ChamferDistance deepest = 0;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto [x, y] = part[k];
        deepest = std::max(deepest, depth(x, y));
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!mask.contains(x + dx, y + dy))
            enclosed = false;
          else if (open(x + dx, y + dy)) {
            open.clear(x + dx, y + dy);
            part.push_back({x + dx, y + dy});
          }
        }
      }
      if (enclosed && pixels_of(deepest) < radius)
        for (const auto& [x, y] : part) mask.set(x, y);
    }
}

BitImage draw_silhouette(const NormalizedShape& shape, const ViewPlane& plane, int resolution) {
  const SnappedPoints points = snap(shape, plane, resolution);
  BitImage mask = fill_triangles(points, shape.triangles, resolution);
  trace_thin_triangles(mask, points, shape.triangles, resolution);
  if (!shape.closed) fill_small_holes(mask, kSmallHole * resolution);
  return mask;
}

}  // namespace marrow
