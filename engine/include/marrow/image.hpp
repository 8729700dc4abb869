// Images: one value per pixel, or one bit per pixel in 64-bit words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// `width` x `height` values, row by row.
template <class T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T value = {})
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  T& operator()(int x, int y) { return pixels_[index(x, y)]; }
  const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }
  T* row(int y) { return pixels_.data() + index(0, y); }
  const T* row(int y) const { return pixels_.data() + index(0, y); }
  std::span<T> pixels() { return pixels_; }
  std::span<const T> pixels() const { return pixels_; }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0, height_ = 0;
  std::vector<T> pixels_;
};

/// One bit per pixel; bit x % 64 of word x / 64 of a row. Bits past the width are zero.
class BitImage {
 public:
  using Word = std::uint64_t;

  BitImage() = default;
  BitImage(int width, int height)
      : width_(width),
        height_(height),
        words_((width + 63) / 64),
        bits_(static_cast<std::size_t>(words_) * static_cast<std::size_t>(height), 0) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int words_per_row() const { return words_; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  bool operator()(int x, int y) const { return row(y)[x >> 6] >> (x & 63) & 1; }
  void set(int x, int y) { row(y)[x >> 6] |= Word{1} << (x & 63); }
  void clear(int x, int y) { row(y)[x >> 6] &= ~(Word{1} << (x & 63)); }
  Word* row(int y) {
    return bits_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(words_);
  }
  const Word* row(int y) const {
    return bits_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(words_);
  }
  std::span<Word> words() { return bits_; }
  std::span<const Word> words() const { return bits_; }

  friend bool operator==(const BitImage&, const BitImage&) = default;

 private:
  int width_ = 0, height_ = 0, words_ = 0;
  std::vector<Word> bits_;
};

/// Columns [left, right) and rows [top, bottom) of an image.
struct PixelBox {
  int left = 0, right = 0, top = 0, bottom = 0;

  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// The least box that holds all set pixels; empty when there are none.
PixelBox bounding_box(const BitImage& image);

/// Number of set pixels.
std::size_t count(const BitImage& image);

/// The pixels that are not set.
BitImage complement(const BitImage& image);

/// The pixels of either image; both have one size.
BitImage united(BitImage a, const BitImage& b);

/// The pixels of `a` that are not in `b`; both have one size.
BitImage without(BitImage a, const BitImage& b);

/// Every pixel within `radius` pixels (Euclidean, centre to centre) of a set pixel. `radius` >= 0.
BitImage dilate(const BitImage& image, double radius);

/// Every pixel with a set pixel in the box of `rx` columns and `ry` rows on each side of it.
BitImage dilate_box(const BitImage& image, int rx, int ry);

/// Every pixel with only set pixels in that box; what lies outside the image is not set.
BitImage erode_box(const BitImage& image, int rx, int ry);

}  // namespace marrow
