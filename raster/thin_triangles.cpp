#include <numeric>
#include <utility>

#include "lattice_triangle_detail.hpp"
#include "thin_triangles_detail.hpp"

namespace marrow {

namespace {

constexpr int kBlockShift = 3;   // blocks of 8 x 8 pixels
constexpr int kPieceSteps = 16;  // of a long edge

/// Whether the bits `first` to `last` of a row are set.
bool are_set(const BitImage::Word* row, int first, int last) {
  for (int i = first >> 6; i <= last >> 6; ++i) {
    const int from = std::max(first - 64 * i, 0), to = std::min(last - 64 * i, 63);
    if ((~row[i] << (63 - to) >> (63 - to + from)) != 0) return false;
  }
  return true;
}

/// One bit for every block of 8 x 8 pixels: whether the image fills it.
BitImage full_blocks(const BitImage& image) {
  const int side = 1 << kBlockShift;
  BitImage blocks(image.width() / side, image.height() / side);
  for (int by = 0; by < blocks.height(); ++by)
    for (int i = 0; i < image.words_per_row(); ++i) {
      BitImage::Word all = ~BitImage::Word{0};
      for (int y = side * by; y < side * (by + 1); ++y) all &= image.row(y)[i];
      for (int k = 0; k < 64 / side; ++k)
        if ((all >> (side * k) & 0xff) == 0xff) blocks.set(i * (64 / side) + k, by);
    }
  return blocks;
}

/// from + (to - from) * i / steps for one i after the other: the division rounds towards `from`.
class Walk {
 public:
  Walk(int from, int to, int steps)
      : from_(from), sign_(to < from ? -1 : 1), length_(std::abs(to - from)), steps_(steps) {}

  int at(int i) const { return from_ + sign_ * (length_ * i / steps_); }
  void go_to(int i) { whole_ = length_ * i / steps_, rest_ = length_ * i % steps_; }
  int place() const { return from_ + sign_ * whole_; }
  void step() {
    whole_ += length_ / steps_, rest_ += length_ % steps_;
    if (rest_ >= steps_) ++whole_, rest_ -= steps_;
  }

 private:
  int from_, sign_, length_, steps_;
  int whole_ = 0, rest_ = 0;
};

/// Corners of a triangle, in pixels of the lattice.
struct Corner {
  int x, y;
};

/// Draws edges where nothing of the mask is near.
class EdgeTrace {
 public:
  EdgeTrace(const BitImage& near_mask, int shift)
      : trace(near_mask.width(), near_mask.height()),
        near_(near_mask),
        blocks_(full_blocks(near_mask)),
        shift_(shift) {}

  void draw(const std::array<Corner, 3>& corners) {
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    if (is_covered({left, low}, {right, high})) return;
    for (std::size_t i = 0; i < 3; ++i) draw_edge(corners[i], corners[(i + 1) % 3]);
  }

  BitImage trace;

 private:
  /// The order of the ends is nothing.
  void draw_edge(Corner a, Corner b) {
    if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
    const int steps = (std::max(b.x - a.x, std::abs(b.y - a.y)) >> shift_) + 1;
    Walk x(a.x, b.x, steps), y(a.y, b.y, steps);
    for (int first = 0; first <= steps; first += kPieceSteps) {
      const int last = std::min(first + kPieceSteps - 1, steps);
      if (!is_covered({x.at(first), y.at(first)}, {x.at(last), y.at(last)}))
        draw_piece(x, y, first, last);
    }
  }

  void draw_piece(Walk& x, Walk& y, int first, int last) {
    x.go_to(first), y.go_to(first);
    for (int i = first; i <= last; ++i, x.step(), y.step()) {
      const int px = nearest_pixel(x.place(), shift_), py = nearest_pixel(y.place(), shift_);
      if (!near_(px, py)) trace.set(px, py);
    }
  }

  /// Whether the mask is known to be near to all pixels between a and b.
  bool is_covered(Corner a, Corner b) const {
    const auto block = [&](int c) { return nearest_pixel(c, shift_) >> kBlockShift; };
    const int left = block(std::min(a.x, b.x)), right = block(std::max(a.x, b.x));
    const int high = block(std::max(a.y, b.y));
    if (right >= blocks_.width() || high >= blocks_.height()) return false;
    for (int by = block(std::min(a.y, b.y)); by <= high; ++by)
      if (!are_set(blocks_.row(by), left, right)) return false;
    return true;
  }

  const BitImage& near_;
  BitImage blocks_;
  int shift_;
};

/// The edges of a small triangle stay within a pixel of its corners: those of which a corner is
/// uncovered.
std::vector<std::uint32_t> uncovered(const SnappedPoints& points,
                                     std::span<const Triangle> triangles, const BitImage& near_mask,
                                     int shift) {
  std::vector<std::uint32_t> chosen;
  if (holds_all(near_mask, points, shift)) return chosen;
  std::vector<std::uint8_t> is_uncovered(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    is_uncovered[i] =
        !near_mask(nearest_pixel(points.x(i), shift), nearest_pixel(points.y(i), shift));
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    if ((is_uncovered[t[0]] | is_uncovered[t[1]] | is_uncovered[t[2]]) != 0) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

void trace_thin(BitImage& mask, const SnappedPoints& points, std::span<const Triangle> triangles,
                std::span<const std::uint32_t> large, int resolution) {
  const int shift = lattice_shift(resolution);
  const std::int64_t thin = std::int64_t{8} << (2 * shift);
  const BitImage near_mask = dilate(mask, 1.5);
  EdgeTrace edges(near_mask, shift);
  const auto trace = [&](std::uint32_t i) {
    std::array<Corner, 3> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = {points.x(triangles[i][k]), points.y(triangles[i][k])};
    const std::int64_t twice_area = std::int64_t{c[1].x - c[0].x} * (c[2].y - c[0].y) -
                                    std::int64_t{c[2].x - c[0].x} * (c[1].y - c[0].y);
    if (std::abs(twice_area) < thin) edges.draw(c);
  };
  for (const std::uint32_t i : large) trace(i);
  for (const std::uint32_t i : uncovered(points, triangles, near_mask, shift)) trace(i);
  for (int y = 0; y < resolution; ++y)
    for (int i = 0; i < mask.words_per_row(); ++i) mask.row(y)[i] |= edges.trace.row(y)[i];
}

void trace_thin_triangles(BitImage& mask, const SnappedPoints& points,
                          std::span<const Triangle> triangles, int resolution) {
  const int shift = lattice_shift(resolution);
  std::vector<std::uint32_t> large;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const LatticeTriangle box(points, triangles[i], shift);
    if (box.right - box.left > 1 || box.high - box.low > 1) large.push_back(i);
  }
  trace_thin(mask, points, triangles, large, resolution);
}

}  // namespace marrow
