#include "picture/strokes.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "picture/colour_map.hpp"

namespace marrow {
namespace {

constexpr int kTile = 32;
constexpr int kSamples = 16;
constexpr Colour kOutline = from_bytes(28, 26, 40);

/// As many places across as down, no two in a row or column.
constexpr std::array<int, kSamples> kSpread = {5, 12, 1, 9,  15, 3,  7, 11,
                                               0, 13, 6, 10, 2,  14, 4, 8};

/// The nearest thing so far at one place of a pixel.
struct Sample {
  float nearness = -std::numeric_limits<float>::infinity();
  Colour colour;
};

/// A stroke prepared for many questions: a tube with round ends, seen along z.
class Brush {
 public:
  Brush(const Stroke& stroke, const Colour& haze)
      : stroke_(stroke),
        haze_(haze),
        ax_(static_cast<float>(stroke.a.x)),
        ay_(static_cast<float>(stroke.a.y)),
        az_(static_cast<float>(stroke.a.z)),
        dx_(static_cast<float>(stroke.b.x - stroke.a.x)),
        dy_(static_cast<float>(stroke.b.y - stroke.a.y)),
        dz_(static_cast<float>(stroke.b.z - stroke.a.z)),
        radius_(stroke.radius) {
    const float flat = dx_ * dx_ + dy_ * dy_;
    length_ = std::sqrt(flat + dz_ * dz_);
    has_body_ = flat > 1e-6F * length_ * length_ && flat > 1e-12F;
    inverse_ = has_body_ ? 1 / flat : 0;
    const float steepness = has_body_ ? std::abs(dz_) / std::sqrt(flat) : 0;
    outline_depth_ = radius_ * (1.5F + std::min(steepness, 6.0F));
  }

  float reach() const { return radius_ + stroke_.outline; }

  /// Nothing of the stroke is nearer than this.
  float nearest() const { return std::max(az_, az_ + dz_) + radius_; }

  float squared_distance(float x, float y) const {
    const float t = place(x, y);
    const float ox = x - ax_ - t * dx_;
    const float oy = y - ay_ - t * dy_;
    return ox * ox + oy * oy;
  }

  /// Paints one sample where the stroke is the nearest thing at (x, y).
  void paint(Sample& sample, float x, float y) const {
    const float squared = squared_distance(x, y);
    if (squared >= reach() * reach()) return;
    if (squared >= radius_ * radius_) {
      // Behind the stroke's own axis, the more the steeper it runs, so that its outline does not
      // cut into the strokes that go on from it.
      const float t = place(x, y);
      lay(sample, az_ + t * dz_ - outline_depth_, hazy(kOutline, t));
      return;
    }
    const float px = x - ax_;
    const float py = y - ay_;
    const Hit hit = foremost(px, py);
    if (hit.z + az_ <= sample.nearness) return;
    const std::array<float, 3> normal = {(px - hit.t * dx_) / radius_, (py - hit.t * dy_) / radius_,
                                         (hit.z - hit.t * dz_) / radius_};
    lay(sample, hit.z + az_, hazy(lit(hit.t, normal), hit.t));
  }

 private:
  /// Height over `a`, and place along the axis, 0..1.
  struct Hit {
    float z = -std::numeric_limits<float>::infinity();
    float t = 0;
  };

  /// Place of the nearest point of the axis in the picture, 0..1.
  float place(float x, float y) const {
    return std::clamp(((x - ax_) * dx_ + (y - ay_) * dy_) * inverse_, 0.0F, 1.0F);
  }

  /// The foremost point at (px, py), relative to `a`, of the tube or the balls at its ends. Exact,
  /// so that no seam shows where one stroke goes on as the next.
  Hit foremost(float px, float py) const {
    Hit best;
    const auto try_ball = [&](float t) {
      const float ox = px - t * dx_;
      const float oy = py - t * dy_;
      const float squared = radius_ * radius_ - ox * ox - oy * oy;
      if (squared < 0) return;
      const float z = t * dz_ + std::sqrt(squared);
      if (z > best.z) best = {z, t};
    };
    try_ball(0);
    try_ball(1);
    if (!has_body_) return best;
    const float ux = dx_ / length_;
    const float uy = dy_ / length_;
    const float uz = dz_ / length_;
    const float along = px * ux + py * uy;
    const float flat = ux * ux + uy * uy;
    const float root =
        along * along * uz * uz - flat * (px * px + py * py - along * along - radius_ * radius_);
    if (root < 0) return best;
    const float z = (along * uz + std::sqrt(root)) / flat;
    const float t = (along + z * uz) / length_;
    if (t >= 0 && t <= 1 && z > best.z) best = {z, t};
    return best;
  }

  static void lay(Sample& sample, float nearness, const Colour& colour) {
    if (nearness <= sample.nearness) return;
    sample = {nearness, colour};
  }

  Colour hazy(const Colour& colour, float t) const {
    return mix(colour, haze_, stroke_.haze_a + t * (stroke_.haze_b - stroke_.haze_a));
  }

  /// Light from the upper left; picture y points down.
  Colour lit(float t, const std::array<float, 3>& normal) const {
    const Colour base =
        stroke_.is_marked
            ? stroke_.colour
            : radius_colour(stroke_.value_a + t * (stroke_.value_b - stroke_.value_a));
    const float facing = std::max(0.0F, -0.40F * normal[0] - 0.55F * normal[1] + 0.73F * normal[2]);
    const float soft = 0.62F + 0.42F * facing;
    const float gleam = facing * facing * facing * facing;
    return mix(base * soft, {1, 1, 1}, 0.30F * gleam * gleam * gleam);
  }

  const Stroke& stroke_;
  const Colour& haze_;
  float ax_, ay_, az_, dx_, dy_, dz_, radius_;
  float length_ = 0, inverse_ = 0, outline_depth_ = 0;
  bool has_body_ = false;
};

/// Pixels that a stroke can touch.
Rect bounds_of(const Stroke& stroke) {
  const double reach = static_cast<double>(stroke.radius + stroke.outline) + 1;
  // Far outside the picture is as good as infinitely far, and fits an int.
  const auto whole = [](double v) {
    return static_cast<int>(std::floor(std::clamp(v, -1e6, 1e6)));
  };
  const int left = whole(std::min(stroke.a.x, stroke.b.x) - reach);
  const int top = whole(std::min(stroke.a.y, stroke.b.y) - reach);
  const int right = whole(std::max(stroke.a.x, stroke.b.x) + reach) + 1;
  const int bottom = whole(std::max(stroke.a.y, stroke.b.y) + reach) + 1;
  return {left, top, right - left, bottom - top};
}

Rect overlap(const Rect& a, const Rect& b) {
  const int left = std::max(a.left, b.left);
  const int top = std::max(a.top, b.top);
  return {left, top, std::max(0, std::min(a.right(), b.right()) - left),
          std::max(0, std::min(a.bottom(), b.bottom()) - top)};
}

struct Pixel {
  std::array<Sample, kSamples> samples;
  /// The farthest of them: what is behind it need not be looked at.
  float farthest = -std::numeric_limits<float>::infinity();
};
using Pixels = std::vector<Pixel>;

Pixel& pixel_at(Pixels& pixels, const Rect& tile, int x, int y) {
  return pixels[static_cast<std::size_t>((y - tile.top) * kTile + x - tile.left)];
}

void paint_pixel(Pixel& pixel, const Brush& brush, int x, int y) {
  pixel.farthest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < kSamples; ++i) {
    const float across = (static_cast<float>(kSpread[i]) + 0.5F) / kSamples;
    const float down = (static_cast<float>(i) + 0.5F) / kSamples;
    brush.paint(pixel.samples[i], static_cast<float>(x) + across, static_cast<float>(y) + down);
    pixel.farthest = std::min(pixel.farthest, pixel.samples[i].nearness);
  }
}

void paint_stroke(Pixels& pixels, const Rect& tile, const Stroke& stroke, const Colour& haze) {
  const Brush brush(stroke, haze);
  const Rect area = overlap(tile, bounds_of(stroke));
  const float reach = brush.reach() + 0.75F;  // to the farthest corner of a pixel
  for (int y = area.top; y < area.bottom(); ++y) {
    for (int x = area.left; x < area.right(); ++x) {
      Pixel& pixel = pixel_at(pixels, tile, x, y);
      if (brush.nearest() <= pixel.farthest) continue;
      const float middle_x = static_cast<float>(x) + 0.5F;
      const float middle_y = static_cast<float>(y) + 0.5F;
      if (brush.squared_distance(middle_x, middle_y) > reach * reach) continue;
      paint_pixel(pixel, brush, x, y);
    }
  }
}

void blend_tile(Canvas& canvas, const Rect& tile, Pixels& pixels) {
  for (int y = tile.top; y < tile.bottom(); ++y) {
    for (int x = tile.left; x < tile.right(); ++x) {
      Colour sum;
      int covered = 0;
      for (const Sample& sample : pixel_at(pixels, tile, x, y).samples) {
        if (!(sample.nearness > -std::numeric_limits<float>::infinity())) continue;
        sum = sum + sample.colour;
        ++covered;
      }
      if (covered == 0) continue;
      const auto part = static_cast<float>(covered);
      canvas.blend(x, y, sum * (1 / part), part / kSamples);
    }
  }
}

/// For every tile of `area` the strokes that may touch it, in their order.
std::vector<std::vector<std::uint32_t>> bin(const Rect& area, int columns, int rows,
                                            const std::vector<Stroke>& strokes) {
  std::vector<std::vector<std::uint32_t>> tiles(static_cast<std::size_t>(columns) *
                                                static_cast<std::size_t>(rows));
  for (std::uint32_t i = 0; i < strokes.size(); ++i) {
    const Rect box = overlap(area, bounds_of(strokes[i]));
    if (box.width == 0 || box.height == 0) continue;
    const int last_column = (box.right() - 1 - area.left) / kTile;
    const int last_row = (box.bottom() - 1 - area.top) / kTile;
    for (int row = (box.top - area.top) / kTile; row <= last_row; ++row) {
      for (int column = (box.left - area.left) / kTile; column <= last_column; ++column) {
        const auto tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                          static_cast<std::size_t>(column);
        tiles[tile].push_back(i);
      }
    }
  }
  return tiles;
}

}  // namespace

void draw_strokes(Canvas& canvas, const Rect& area, const std::vector<Stroke>& strokes,
                  const Colour& haze) {
  const int columns = (area.width + kTile - 1) / kTile;
  const int rows = (area.height + kTile - 1) / kTile;
  auto tiles = bin(area, columns, rows, strokes);
  tbb::parallel_for(0, columns * rows, [&](int i) {
    auto& touching = tiles[static_cast<std::size_t>(i)];
    if (touching.empty()) return;
    // The nearest first: most of a thicket is then hidden when its turn comes.
    std::stable_sort(touching.begin(), touching.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::max(strokes[a].a.z, strokes[a].b.z) > std::max(strokes[b].a.z, strokes[b].b.z);
    });
    const Rect tile = overlap(
        area, {area.left + i % columns * kTile, area.top + i / columns * kTile, kTile, kTile});
    Pixels pixels(std::size_t{kTile} * kTile);
    for (const std::uint32_t stroke : touching) paint_stroke(pixels, tile, strokes[stroke], haze);
    blend_tile(canvas, tile, pixels);
  });
}

}  // namespace marrow
