// Pixels: 8-bit grey and RGB pictures, and the colours and canvas they are painted with.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marrow {

/// 8-bit grey, row by row from the top.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  friend bool operator==(const GreyImage&, const GreyImage&) = default;
};

/// 8-bit red, green, blue, row by row from the top.
struct RgbImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  friend bool operator==(const RgbImage&, const RgbImage&) = default;
};

/// A colour while painting; 0..1 per channel.
struct Colour {
  float r = 0, g = 0, b = 0;

  friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

constexpr Colour operator+(const Colour& a, const Colour& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Colour operator*(const Colour& a, float s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Colour mix(const Colour& a, const Colour& b, float t) { return a * (1 - t) + b * t; }
constexpr Colour from_bytes(int r, int g, int b) {
  return {static_cast<float>(r) / 255.0F, static_cast<float>(g) / 255.0F,
          static_cast<float>(b) / 255.0F};
}

/// A rectangle of pixels: x in [left, left + width).
struct Rect {
  int left = 0, top = 0, width = 0, height = 0;

  constexpr int right() const { return left + width; }
  constexpr int bottom() const { return top + height; }
};

/// A picture while it is painted.
class Canvas {
 public:
  Canvas(int width, int height, const Colour& paper)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), paper) {}

  int width() const { return width_; }
  int height() const { return height_; }
  Rect bounds() const { return {0, 0, width_, height_}; }
  Colour& at(int x, int y) { return pixels_[index(x, y)]; }
  const Colour& at(int x, int y) const { return pixels_[index(x, y)]; }

  /// Lays `colour` over one pixel; pixels outside are left out.
  void blend(int x, int y, const Colour& colour, float alpha) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    at(x, y) = mix(at(x, y), colour, alpha);
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<Colour> pixels_;
};

inline std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

/// The finished picture.
RgbImage to_image(const Canvas& canvas);

}  // namespace marrow
