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

}  // namespace marrow
