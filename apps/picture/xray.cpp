#include "picture/xray.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

namespace marrow {
namespace {

constexpr Colour kLit = from_bytes(214, 226, 236);
constexpr Colour kShaded = from_bytes(84, 110, 140);
constexpr Colour kRim = from_bytes(44, 66, 98);
constexpr float kFrontOpacity = 0.50F;  // of the first surface, seen face on
constexpr float kInnerOpacity = 0.07F;  // of those behind it
constexpr float kRimOpacity = 0.75F;    // more where it turns away
constexpr float kEdgeContrast = 0.02F;  // between neighbours, above which a pixel is refined
constexpr double kStart = 4;            // of the lines, in front of everything

/// Sixteen places in a pixel, no two in a row or column: as many steps as an edge can show.
constexpr std::array<int, kBundle> kSpread = {5, 12, 1, 9, 15, 3, 7, 11, 0, 13, 6, 10, 2, 14, 4, 8};

float cube(float x) { return x * x * x; }

/// Light from the upper left, over the viewer's shoulder, wrapped around so that nothing is black.
float light_on(const std::array<float, 3>& normal, const View& view) {
  const auto along = [&](const Vec3& axis) {
    return static_cast<float>(axis.x) * normal[0] + static_cast<float>(axis.y) * normal[1] +
           static_cast<float>(axis.z) * normal[2];
  };
  const float facing =
      -0.40F * along(view.right) + 0.62F * along(view.up) + 0.675F * along(view.toward);
  return std::clamp(0.35F + 0.65F * facing, 0.0F, 1.0F);
}

/// What a line of sight shows, front to back.
Colour shade(const SurfaceTracer& shape, const View& view, const Colour& paper,
             std::span<const SurfaceHit> hits) {
  Colour colour;
  float open = 1;  // what is still to be seen behind
  bool first = true;
  for (const SurfaceHit& hit : hits) {
    const std::array<float, 3> normal = shape.normal_at(hit, -view.toward);
    const float facing = std::min(1.0F, static_cast<float>(view.toward.x) * normal[0] +
                                            static_cast<float>(view.toward.y) * normal[1] +
                                            static_cast<float>(view.toward.z) * normal[2]);
    const float turned = cube(1 - std::max(facing, 0.0F));
    const Colour skin = mix(kShaded, kLit, light_on(normal, view));
    const float opacity = (first ? kFrontOpacity : kInnerOpacity) +
                          (first ? kRimOpacity : 0.5F * kRimOpacity) * turned;
    const float alpha = std::min(opacity, 1.0F);
    colour = colour + mix(skin, kRim, turned) * (alpha * open);
    open *= 1 - alpha;
    first = false;
  }
  return colour + paper * open;
}

/// The lines of sight through sixteen places of the picture.
class Sights {
 public:
  Sights(const SurfaceTracer& shape, const View& view, const Colour& paper)
      : shape_(shape), view_(view), paper_(paper) {}

  /// Place of line `i`, in pixels.
  void aim(int i, double x, double y) {
    const Vec3 start = view_.unproject(x, y) + view_.toward * kStart;
    const auto k = static_cast<std::size_t>(i);
    bundle_.x[k] = static_cast<float>(start.x);
    bundle_.y[k] = static_cast<float>(start.y);
    bundle_.z[k] = static_cast<float>(start.z);
  }
  void trace() { shape_.trace(bundle_, -view_.toward, hits_); }
  Colour seen(int i) const { return shade(shape_, view_, paper_, hits_.of(i)); }

 private:
  const SurfaceTracer& shape_;
  const View& view_;
  const Colour& paper_;
  Bundle bundle_{};
  BundleHits hits_;
};

/// Runs `paint(tile)` over the tiles of `area`, all of them multiples of four pixels but the last.
template <class Paint>
void for_tiles(const Rect& area, const Paint& paint) {
  constexpr int kTile = 32;
  const int columns = (area.width + kTile - 1) / kTile;
  const int rows = (area.height + kTile - 1) / kTile;
  tbb::parallel_for(0, columns * rows, [&](int i) {
    const int left = area.left + i % columns * kTile;
    const int top = area.top + i / columns * kTile;
    paint(Rect{left, top, std::min(kTile, area.right() - left),
               std::min(kTile, area.bottom() - top)});
  });
}

/// One line through the middle of every pixel, four by four pixels together.
void draw_centres(Canvas& canvas, const SurfaceTracer& shape, const View& view,
                  const Colour& paper) {
  for_tiles(view.cell, [&](const Rect& tile) {
    Sights sights(shape, view, paper);
    for (int y = tile.top; y < tile.bottom(); y += 4) {
      for (int x = tile.left; x < tile.right(); x += 4) {
        for (int i = 0; i < kBundle; ++i) {
          const int px = x + i % 4;
          const int py = y + i / 4;
          sights.aim(i, px + 0.5, py + 0.5);
        }
        sights.trace();
        for (int i = 0; i < kBundle; ++i) {
          const int px = x + i % 4;
          const int py = y + i / 4;
          if (px < tile.right() && py < tile.bottom()) canvas.at(px, py) = sights.seen(i);
        }
      }
    }
  });
}

float contrast(const Colour& a, const Colour& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

bool is_edge(const Canvas& canvas, const Rect& cell, int x, int y) {
  const Colour& here = canvas.at(x, y);
  const auto differs = [&](int nx, int ny) {
    return nx >= cell.left && ny >= cell.top && nx < cell.right() && ny < cell.bottom() &&
           contrast(here, canvas.at(nx, ny)) > kEdgeContrast;
  };
  return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
}

/// Pixels that differ from a neighbour become the mean of sixteen lines.
void refine_edges(Canvas& canvas, const SurfaceTracer& shape, const View& view,
                  const Colour& paper) {
  const Canvas coarse = canvas;
  for_tiles(view.cell, [&](const Rect& tile) {
    Sights sights(shape, view, paper);
    for (int y = tile.top; y < tile.bottom(); ++y) {
      for (int x = tile.left; x < tile.right(); ++x) {
        if (!is_edge(coarse, view.cell, x, y)) continue;
        for (int i = 0; i < kBundle; ++i) {
          const int across = kSpread[static_cast<std::size_t>(i)];
          sights.aim(i, x + (across + 0.5) / kBundle, y + (i + 0.5) / kBundle);
        }
        sights.trace();
        Colour sum;
        for (int i = 0; i < kBundle; ++i) sum = sum + sights.seen(i);
        canvas.at(x, y) = sum * (1.0F / kBundle);
      }
    }
  });
}

}  // namespace

void draw_xray(Canvas& canvas, const SurfaceTracer& shape, const View& view, const Colour& paper) {
  draw_centres(canvas, shape, view, paper);
  refine_edges(canvas, shape, view, paper);
}

}  // namespace marrow
