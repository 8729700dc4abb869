#include "picture/render.hpp"

#include <algorithm>
#include <span>

#include "picture/font.hpp"
#include "picture/legend.hpp"
#include "picture/scene.hpp"
#include "picture/surface_hits.hpp"
#include "picture/xray.hpp"

namespace marrow {
namespace {

void rule(Canvas& canvas, const Rect& line, const Colour& ink) {
  for (int y = line.top; y < line.bottom(); ++y) {
    for (int x = line.left; x < line.right(); ++x) canvas.blend(x, y, ink, 1);
  }
}

/// Lines between the cells, and the name of every view.
void draw_frame(Canvas& canvas, std::span<const View> views, float dot, const Inks& inks) {
  const int thick = std::max(1, static_cast<int>(0.5F * dot));
  for (const View& view : views) {
    const Rect& cell = view.cell;
    if (cell.left > 0) rule(canvas, {cell.left, cell.top, thick, cell.height}, inks.rule);
    rule(canvas, {cell.left, cell.bottom() - thick, cell.width, thick}, inks.rule);
    draw_text(canvas, static_cast<float>(cell.left) + 8 * dot,
              static_cast<float>(cell.top) + 8 * dot, view.name, dot, inks.faint);
  }
}

}  // namespace

RgbImage render_picture(const Shape& shape, const CurveSkeleton& skeleton,
                        const RenderOptions& options) {
  const Scene scene = scene_of(shape, skeleton, options);
  const Inks inks = inks_on(options.background);
  Canvas canvas(options.width, options.height, options.background);
  const SurfaceTracer surface(shape, scene.pose, scene.sizes.disc / scene.views[0].scale);
  for (const View& view : scene.views) draw_xray(canvas, surface, view, options.background);
  if (options.legend) draw_frame(canvas, scene.views, scene.sizes.dot, inks);
  for (const View& view : scene.views)
    draw_strokes(canvas, view.cell, strokes_of(skeleton, scene, view), inks.haze);
  if (options.legend) draw_legend(canvas, scene.legend, skeleton, scene.sizes.dot, inks.text);
  return to_image(canvas);
}

}  // namespace marrow
