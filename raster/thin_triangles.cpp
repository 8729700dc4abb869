#include <algorithm>
#include <utility>

#include "mask_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

constexpr int kPieceSteps = 16;       // of an edge are drawn together
constexpr int kFewRows = 10;          // are looked at one by one
constexpr std::size_t kEdges = 1024;  // remembered, a power of two

/// Twice the area under which triangles are thin.
std::int64_t thin_area(int shift) { return std::int64_t{8} << (2 * shift); }

/// Whether the bits `first` to `last` of a row are set.
bool are_set(const BitImage::Word* row, int first, int last) {
  for (int i = first >> 6; i <= last >> 6; ++i) {
    const int from = std::max(first - 64 * i, 0), to = std::min(last - 64 * i, 63);
    if ((~row[i] << (63 - to) >> (63 - to + from)) != 0) return false;
  }
  return true;
}

/// Pixels from (left, low) to (right, high), these included.
struct Extent {
  int left, right, low, high;
};

bool is_set(const BitImage& image, const Extent& box) {
  for (int y = box.low; y <= box.high; ++y)
    if (!are_set(image.row(y), box.left, box.right)) return false;
  return true;
}

/// from + (to - from) * i / steps for one i after the other: the division rounds towards `from`.
class Walk {
 public:
  Walk(int from, int to, int steps)
      : from_(from),
        sign_(to < from ? -1 : 1),
        length_(std::abs(to - from)),
        steps_(steps),
        more_whole_(length_ / steps),
        more_rest_(length_ % steps) {}

  int at(int i) const { return from_ + sign_ * (length_ * i / steps_); }
  void go_to(int i) { whole_ = length_ * i / steps_, rest_ = length_ * i % steps_; }
  int place() const { return from_ + sign_ * whole_; }
  void step() {
    whole_ += more_whole_, rest_ += more_rest_;
    if (rest_ >= steps_) ++whole_, rest_ -= steps_;
  }

 private:
  int from_, sign_, length_, steps_, more_whole_, more_rest_;
  int whole_ = 0, rest_ = 0;
};

/// From the squares of side `side` within an image those twice as long, 32 at most.
BitImage doubled_squares(BitImage squares, int side) {
  const int words = squares.words_per_row();
  for (int y = 0; y < squares.height(); ++y) {
    BitImage::Word* const row = squares.row(y);
    for (int i = 0; i < words; ++i)
      row[i] &= row[i] >> side | (i + 1 < words ? row[i + 1] << (64 - side) : 0);
  }
  for (int y = 0; y < squares.height(); ++y)
    for (int i = 0; i < words; ++i)
      squares.row(y)[i] &= y + side < squares.height() ? squares.row(y + side)[i] : 0;
  return squares;
}

/// Squares within an image, by the length of their sides.
struct Squares {
  explicit Squares(const BitImage& image)
      : of_4(squares_within(image, 4)),
        of_8(doubled_squares(of_4, 4)),
        of_32(doubled_squares(doubled_squares(of_8, 8), 16)) {}

  /// Whether squares within the image make up the box, or one holds it.
  bool hold(const Extent& box) const {
    return std::max(box.right - box.left, box.high - box.low) < 32 ? hold(of_8, 8, box)
                                                                   : hold(of_32, 32, box);
  }

  BitImage of_4, of_8, of_32;

 private:
  static bool hold(const BitImage& squares, int side, const Extent& box) {
    const int last_x = std::max(box.left, box.right - side + 1);
    const int last_y = std::max(box.low, box.high - side + 1);
    for (int y = box.low; y <= box.high; y += side)
      for (int x = box.left; x <= box.right; x += side)
        if (!squares(std::min(x, last_x), std::min(y, last_y))) return false;
    return true;
  }
};

/// Draws edges where nothing of the mask is near.
class EdgeTrace {
 public:
  EdgeTrace(const BitImage& near_mask, const Squares& squares, int shift)
      : trace(near_mask.width(), near_mask.height()),
        near_(near_mask),
        squares_(squares),
        shift_(shift) {
    known_.fill(~std::uint64_t{0});
  }

  void draw(const std::array<LatticePoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    const LatticePoint low{std::min(std::min(a.x, b.x), c.x), std::min(std::min(a.y, b.y), c.y)};
    const LatticePoint high{std::max(std::max(a.x, b.x), c.x), std::max(std::max(a.y, b.y), c.y)};
    if (is_covered(low, high)) return;
    for (std::size_t i = 0; i < 3; ++i) draw_edge(corners[i], corners[(i + 1) % 3]);
  }

  BitImage trace;

 private:
  /// The order of the ends is nothing.
  void draw_edge(LatticePoint a, LatticePoint b) {
    if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
    if (is_known(a, b)) return;
    const int steps = (std::max(b.x - a.x, std::abs(b.y - a.y)) >> shift_) + 1;
    Walk x(a.x, b.x, steps), y(a.y, b.y, steps);
    draw_steps(x, y, 0, steps);
  }

  /// Most edges come twice, and those of neighbours soon one after the other.
  bool is_known(LatticePoint a, LatticePoint b) {
    const auto word = [](int high, int low) {
      return static_cast<std::uint64_t>(high) << 16 | static_cast<std::uint64_t>(low);
    };
    const std::uint64_t ends = word(a.x, a.y) << 32 | word(b.x, b.y);
    std::uint64_t& known = known_[(ends * 0x9e3779b97f4a7c15u >> 32) % kEdges];
    return std::exchange(known, ends) == ends;
  }

  void draw_steps(Walk& x, Walk& y, int first, int last) {
    if (is_covered({x.at(first), y.at(first)}, {x.at(last), y.at(last)})) return;
    if (last - first > kPieceSteps) {
      const int middle = (first + last) / 2;
      draw_steps(x, y, first, middle);
      draw_steps(x, y, middle + 1, last);
      return;
    }
    x.go_to(first), y.go_to(first);
    for (int i = first; i <= last; ++i, x.step(), y.step()) {
      const int px = nearest_pixel(x.place(), shift_), py = nearest_pixel(y.place(), shift_);
      if (!near_(px, py)) trace.set(px, py);
    }
  }

  /// Whether the mask is known to be near to all pixels between a and b.
  bool is_covered(LatticePoint a, LatticePoint b) const {
    const Extent box = {
        nearest_pixel(std::min(a.x, b.x), shift_), nearest_pixel(std::max(a.x, b.x), shift_),
        nearest_pixel(std::min(a.y, b.y), shift_), nearest_pixel(std::max(a.y, b.y), shift_)};
    return squares_.hold(box) || (box.high - box.low < kFewRows && is_set(near_, box));
  }

  const BitImage& near_;
  const Squares& squares_;
  int shift_;
  std::array<std::uint64_t, kEdges> known_;
};

/// The edges of a small triangle stay within a pixel of its corners: those of which a corner is
/// uncovered.
PackedTriangles uncovered(const SnappedPoints& points, std::span<const Triangle> triangles,
                          const BitImage& near_mask, int shift) {
  PackedTriangles chosen;
  if (holds_all(near_mask, points, shift)) return chosen;
  std::vector<std::uint8_t> is_uncovered(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    is_uncovered[i] =
        !near_mask(nearest_pixel(points.x(i), shift), nearest_pixel(points.y(i), shift));
  for (const Triangle& t : triangles)
    if ((is_uncovered[t[0]] | is_uncovered[t[1]] | is_uncovered[t[2]]) != 0)
      chosen.push_back(points, t);
  return chosen;
}

/// Whether the image holds the box; most boxes are small.
bool holds(const BitImage& image, const Extent& box) {
  const int word = box.left >> 6;
  if (word != box.right >> 6) return is_set(image, box);
  const BitImage::Word bits = ~BitImage::Word{0} >> (63 - (box.right - box.left))
                                                        << (box.left & 63);
  for (int y = box.low; y <= box.high; ++y)
    if ((~image.row(y)[word] & bits) != 0) return false;
  return true;
}

/// The pixels of the box of a and b, made wider by `more` lattice steps.
Extent extent_of(const LatticePoint& a, const LatticePoint& b, int more, int shift) {
  return {nearest_pixel(std::min(a.x, b.x) - more, shift),
          nearest_pixel(std::max(a.x, b.x) + more, shift),
          nearest_pixel(std::min(a.y, b.y) - more, shift),
          nearest_pixel(std::max(a.y, b.y) + more, shift)};
}

/// Adds the pixels of one contour, in pieces no longer than a pixel.
void add_far(BitImage& far, const BitImage& near_mask, const ContourEdge& edge, int shift) {
  constexpr int kRounding = 2;  // lattice steps, of the places along an edge
  const auto& [a, b] = edge;
  const int steps = (std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) >> shift) + 1;
  if (steps <= 2 && holds(near_mask, extent_of(a, b, kRounding, shift))) return;
  Walk x(a.x, b.x, steps), y(a.y, b.y, steps);
  x.go_to(0), y.go_to(0);
  LatticePoint from = a;
  for (int i = 0; i < steps; ++i) {
    x.step(), y.step();
    const LatticePoint to{x.place(), y.place()};
    const Extent piece = extent_of(from, to, kRounding, shift);
    from = to;
    if (holds(near_mask, piece)) continue;
    for (int row = piece.low; row <= piece.high; ++row)
      set_span(far.row(row), piece.left, piece.right);
  }
}

}  // namespace

BitImage far_contours(std::span<const ContourEdge> contours, const BitImage& mask) {
  const int shift = lattice_shift(mask.width());
  const BitImage near_mask = dilate_box(mask, 1, 1);
  BitImage far(mask.width(), mask.height());
  for (const ContourEdge& edge : contours) add_far(far, near_mask, edge, shift);
  return without(std::move(far), near_mask);
}

PackedTriangles near_to(const BitImage& image, const PackedTriangles& triangles) {
  const int shift = lattice_shift(image.width());
  PackedTriangles chosen;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [a, b, c] = corners_of(triangles, i);
    const LatticePoint low{std::min(std::min(a.x, b.x), c.x), std::min(std::min(a.y, b.y), c.y)};
    const LatticePoint high{std::max(std::max(a.x, b.x), c.x), std::max(std::max(a.y, b.y), c.y)};
    const Extent box = extent_of(low, high, 0, shift);
    if (!is_any_set(image, {box.left, box.right + 1, box.low, box.high + 1})) continue;
    chosen.a.push_back(triangles.a[i]);
    chosen.b.push_back(triangles.b[i]);
    chosen.c.push_back(triangles.c[i]);
  }
  return chosen;
}

void trace_thin(BitImage& mask, const PackedTriangles& near, const PackedTriangles& flat) {
  if (near.size() == 0 && flat.size() == 0) return;
  const int shift = lattice_shift(mask.width());
  const BitImage near_mask = dilate_box(mask, 1, 1);
  const Squares squares(near_mask);
  EdgeTrace edges(near_mask, squares, shift);
  const auto is_uncovered = [&](const LatticePoint& p) {
    return !near_mask(nearest_pixel(p.x, shift), nearest_pixel(p.y, shift));
  };
  for (const PackedTriangles* some : {&near, &flat})
    for (std::size_t i = 0; i < some->size(); ++i) {
      const auto corners = corners_of(*some, i);
      if (std::abs(twice_area(corners)) >= thin_area(shift)) continue;
      if (LatticeTriangle(corners, shift).is_large() ||
          std::any_of(corners.begin(), corners.end(), is_uncovered))
        edges.draw(corners);
    }
  mask = united(std::move(mask), edges.trace);
}

BitImage squares_within(BitImage image, int side) {
  for (int half = 1; half < side; half *= 2) image = doubled_squares(std::move(image), half);
  return image;
}

void trace_thin(BitImage& mask, const SnappedPoints& points, std::span<const Triangle> triangles,
                const PackedTriangles& large, int resolution) {
  const int shift = lattice_shift(resolution);
  const std::int64_t thin = thin_area(shift);
  const BitImage near_mask = dilate(mask, 1.5);
  const Squares squares(near_mask);
  EdgeTrace edges(near_mask, squares, shift);
  const auto trace = [&](const PackedTriangles& some) {
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto corners = corners_of(some, i);
      if (std::abs(twice_area(corners)) < thin) edges.draw(corners);
    }
  };
  const PackedTriangles rest = not_within(squares.of_8, 8, large, shift);
  trace(not_within(squares.of_4, 4, rest, shift));
  trace(uncovered(points, triangles, near_mask, shift));
  mask = united(std::move(mask), edges.trace);
}

void trace_thin_triangles(BitImage& mask, const SnappedPoints& points,
                          std::span<const Triangle> triangles, int resolution) {
  const int shift = lattice_shift(resolution);
  PackedTriangles large;
  for (const Triangle& t : triangles)
    if (LatticeTriangle(corners_of(points, t), shift).is_large()) large.push_back(points, t);
  trace_thin(mask, points, triangles, large, resolution);
}

}  // namespace marrow
