#include "picture/font.hpp"

#include <array>
#include <cmath>

namespace marrow {
namespace {

constexpr int kGlyphWidth = 5;
constexpr int kGlyphHeight = 9;
constexpr int kAdvance = 6;

/// Rows from the top; bit 4 is the leftmost dot. The last two rows are below the line.
struct Glyph {
  char letter;
  std::array<std::uint8_t, kGlyphHeight> rows;
};

constexpr Glyph kBox = {'\0', {0x1F, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1F, 0, 0}};

constexpr Glyph kGlyphs[] = {
    {' ', {0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {'0', {0x0E, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0E, 0, 0}},
    {'1', {0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E, 0, 0}},
    {'2', {0x0E, 0x11, 0x01, 0x06, 0x08, 0x10, 0x1F, 0, 0}},
    {'3', {0x0E, 0x11, 0x01, 0x06, 0x01, 0x11, 0x0E, 0, 0}},
    {'4', {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02, 0, 0}},
    {'5', {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E, 0, 0}},
    {'6', {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E, 0, 0}},
    {'7', {0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08, 0, 0}},
    {'8', {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E, 0, 0}},
    {'9', {0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C, 0, 0}},
    {'a', {0, 0, 0x0E, 0x01, 0x0F, 0x11, 0x0F, 0, 0}},
    {'b', {0x10, 0x10, 0x1E, 0x11, 0x11, 0x11, 0x1E, 0, 0}},
    {'c', {0, 0, 0x0E, 0x11, 0x10, 0x11, 0x0E, 0, 0}},
    {'d', {0x01, 0x01, 0x0F, 0x11, 0x11, 0x11, 0x0F, 0, 0}},
    {'e', {0, 0, 0x0E, 0x11, 0x1F, 0x10, 0x0E, 0, 0}},
    {'f', {0x06, 0x08, 0x1C, 0x08, 0x08, 0x08, 0x08, 0, 0}},
    {'g', {0, 0, 0x0F, 0x11, 0x11, 0x11, 0x0F, 0x01, 0x0E}},
    {'h', {0x10, 0x10, 0x1E, 0x11, 0x11, 0x11, 0x11, 0, 0}},
    {'i', {0x04, 0, 0x0C, 0x04, 0x04, 0x04, 0x0E, 0, 0}},
    {'j', {0x02, 0, 0x06, 0x02, 0x02, 0x02, 0x02, 0x12, 0x0C}},
    {'k', {0x10, 0x10, 0x12, 0x14, 0x18, 0x14, 0x12, 0, 0}},
    {'l', {0x0C, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0E, 0, 0}},
    {'m', {0, 0, 0x1A, 0x15, 0x15, 0x15, 0x15, 0, 0}},
    {'n', {0, 0, 0x1E, 0x11, 0x11, 0x11, 0x11, 0, 0}},
    {'o', {0, 0, 0x0E, 0x11, 0x11, 0x11, 0x0E, 0, 0}},
    {'p', {0, 0, 0x1E, 0x11, 0x11, 0x11, 0x1E, 0x10, 0x10}},
    {'q', {0, 0, 0x0F, 0x11, 0x11, 0x11, 0x0F, 0x01, 0x01}},
    {'r', {0, 0, 0x16, 0x19, 0x10, 0x10, 0x10, 0, 0}},
    {'s', {0, 0, 0x0F, 0x10, 0x0E, 0x01, 0x1E, 0, 0}},
    {'t', {0x08, 0x08, 0x1C, 0x08, 0x08, 0x08, 0x06, 0, 0}},
    {'u', {0, 0, 0x11, 0x11, 0x11, 0x11, 0x0F, 0, 0}},
    {'v', {0, 0, 0x11, 0x11, 0x11, 0x0A, 0x04, 0, 0}},
    {'w', {0, 0, 0x11, 0x15, 0x15, 0x15, 0x0A, 0, 0}},
    {'x', {0, 0, 0x11, 0x0A, 0x04, 0x0A, 0x11, 0, 0}},
    {'y', {0, 0, 0x11, 0x11, 0x11, 0x11, 0x0F, 0x01, 0x0E}},
    {'z', {0, 0, 0x1F, 0x02, 0x04, 0x08, 0x1F, 0, 0}},
    {'.', {0, 0, 0, 0, 0, 0, 0x04, 0, 0}},
    {',', {0, 0, 0, 0, 0, 0, 0x04, 0x04, 0x08}},
    {':', {0, 0, 0, 0x04, 0, 0, 0x04, 0, 0}},
    {'-', {0, 0, 0, 0, 0x0E, 0, 0, 0, 0}},
    {'+', {0, 0, 0x04, 0x04, 0x1F, 0x04, 0x04, 0, 0}},
    {'=', {0, 0, 0, 0x1F, 0, 0x1F, 0, 0, 0}},
    {'_', {0, 0, 0, 0, 0, 0, 0x1F, 0, 0}},
    {'/', {0x01, 0x01, 0x02, 0x04, 0x08, 0x10, 0x10, 0, 0}},
    {'(', {0x02, 0x04, 0x08, 0x08, 0x08, 0x04, 0x02, 0, 0}},
    {')', {0x08, 0x04, 0x02, 0x02, 0x02, 0x04, 0x08, 0, 0}},
    {'%', {0x19, 0x19, 0x02, 0x04, 0x08, 0x13, 0x13, 0, 0}},
    {'#', {0x0A, 0x0A, 0x1F, 0x0A, 0x1F, 0x0A, 0x0A, 0, 0}},
};

const Glyph& glyph_of(char letter) {
  const char lower =
      letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.letter == lower) return glyph;
  }
  return kBox;
}

float dot_of(const Glyph& glyph, int column, int row) {
  if (column < 0 || row < 0 || column >= kGlyphWidth || row >= kGlyphHeight) return 0;
  const int bits = glyph.rows[static_cast<std::size_t>(row)];
  return static_cast<float>((bits >> (kGlyphWidth - 1 - column)) & 1);
}

/// The dots joined smoothly: interpolated between dot centres and cut at half, which rounds
/// corners and closes diagonals, so that an enlarged letter does not look like stairs.
float ink_at(const Glyph& glyph, float x, float y, float scale) {
  const float u = x - 0.5F;
  const float v = y - 0.5F;
  const int column = static_cast<int>(std::floor(u));
  const int row = static_cast<int>(std::floor(v));
  const float fu = u - static_cast<float>(column);
  const float fv = v - static_cast<float>(row);
  const float top = dot_of(glyph, column, row) * (1 - fu) + dot_of(glyph, column + 1, row) * fu;
  const float low =
      dot_of(glyph, column, row + 1) * (1 - fu) + dot_of(glyph, column + 1, row + 1) * fu;
  const float value = top * (1 - fv) + low * fv;
  const float steepness = std::max(1.4F, scale);  // below that even no dot would leave some ink
  return std::clamp((value - 0.38F) * steepness + 0.5F, 0.0F, 1.0F);
}

void draw_glyph(Canvas& canvas, float x, float y, const Glyph& glyph, float scale,
                const Colour& colour) {
  const int left = static_cast<int>(std::floor(x - scale));
  const int top = static_cast<int>(std::floor(y - scale));
  const int right = static_cast<int>(std::ceil(x + scale * (kGlyphWidth + 1)));
  const int bottom = static_cast<int>(std::ceil(y + scale * (kGlyphHeight + 1)));
  for (int py = top; py < bottom; ++py) {
    for (int px = left; px < right; ++px) {
      const float u = (static_cast<float>(px) + 0.5F - x) / scale;
      const float v = (static_cast<float>(py) + 0.5F - y) / scale;
      const float ink = ink_at(glyph, u, v, scale);
      if (ink > 0) canvas.blend(px, py, colour, ink);
    }
  }
}

}  // namespace

float text_height(float scale) { return scale * kGlyphHeight; }

float text_width(std::string_view text, float scale) {
  return text.empty() ? 0 : scale * (static_cast<float>(text.size()) * kAdvance - 1);
}

void draw_text(Canvas& canvas, float x, float y, std::string_view text, float scale,
               const Colour& colour) {
  for (const char letter : text) {
    draw_glyph(canvas, x, y, glyph_of(letter), scale, colour);
    x += scale * kAdvance;
  }
}

}  // namespace marrow
