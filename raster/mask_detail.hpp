// What the silhouettes of surfaces and of points share.
#pragma once

#include <marrow/image.hpp>

namespace marrow {

/// Enclosed holes of less are filled: inscribed radius, in sides of the image.
inline constexpr double kSmallHole = 0.02;

/// Calls change(word, bits) for the words of `row` that hold the pixels from `left` to `right`.
template <class Change>
void change_span(BitImage::Word* row, int left, int right, Change change) {
  const int first = left >> 6, last = right >> 6;
  const BitImage::Word from = ~BitImage::Word{0} << (left & 63);
  const BitImage::Word to = ~BitImage::Word{0} >> (63 - (right & 63));
  if (first == last) return change(row[first], from & to);
  change(row[first], from);
  for (int i = first + 1; i < last; ++i) change(row[i], ~BitImage::Word{0});
  change(row[last], to);
}

inline void set_span(BitImage::Word* row, int left, int right) {
  change_span(row, left, right, [](BitImage::Word& word, BitImage::Word bits) { word |= bits; });
}

inline void clear_span(BitImage::Word* row, int left, int right) {
  change_span(row, left, right, [](BitImage::Word& word, BitImage::Word bits) { word &= ~bits; });
}

/// Whether a pixel of the box, which lies in the image, is set.
inline bool is_any_set(const BitImage& image, const PixelBox& box) {
  const int first = box.left >> 6, last = (box.right - 1) >> 6;
  const BitImage::Word from = ~BitImage::Word{0} << (box.left & 63);
  const BitImage::Word to = ~BitImage::Word{0} >> (63 - ((box.right - 1) & 63));
  for (int y = box.top; y < box.bottom; ++y) {
    const BitImage::Word* const row = image.row(y);
    if (first == last) {
      if ((row[first] & from & to) != 0) return true;
      continue;
    }
    BitImage::Word any = (row[first] & from) | (row[last] & to);
    for (int i = first + 1; i < last; ++i) any |= row[i];
    if (any != 0) return true;
  }
  return false;
}

}  // namespace marrow
