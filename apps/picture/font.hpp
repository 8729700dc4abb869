// A small built-in bitmap font: lower case letters, figures and a few signs.
#pragma once

#include <string_view>

#include "picture/image.hpp"

namespace marrow {

/// Height of a line of text and width of a text, in pixels, at `scale` pixels per dot of the font.
float text_height(float scale);
float text_width(std::string_view text, float scale);

/// Writes `text` with its upper left corner at (x, y). Capitals are written as lower case, unknown
/// letters as a box.
void draw_text(Canvas& canvas, float x, float y, std::string_view text, float scale,
               const Colour& colour);

}  // namespace marrow
