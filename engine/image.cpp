#include <marrow/image.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace marrow {

namespace {

/// target |= source shifted by `dx` pixels to the right (left when negative).
void or_shifted(BitImage::Word* target, const BitImage::Word* source, int words, int dx) {
  const int shift = dx >= 0 ? dx : -dx;
  const int whole = shift / 64, part = shift % 64;
  for (int i = 0; i < words; ++i) {
    const int j = dx >= 0 ? i - whole : i + whole;
    const int next = dx >= 0 ? j - 1 : j + 1;
    if (j >= 0 && j < words) target[i] |= dx >= 0 ? source[j] << part : source[j] >> part;
    if (part != 0 && next >= 0 && next < words)
      target[i] |= dx >= 0 ? source[next] >> (64 - part) : source[next] << (64 - part);
  }
}

/// Widens what is set in `row` from `half` pixels on each side of what was there to `wanted`;
/// `before` is room to work in.
void widen(std::vector<BitImage::Word>& row, std::vector<BitImage::Word>& before, int half,
           int wanted) {
  const int words = static_cast<int>(row.size());
  while (half < wanted) {
    const int step = std::min(wanted - half, 2 * half + 1);  // so that no gap is left
    before = row;
    or_shifted(row.data(), before.data(), words, step);
    or_shifted(row.data(), before.data(), words, -step);
    half += step;
  }
}

/// The bits of a row's last word that lie in the image.
BitImage::Word last_word_mask(const BitImage& image) {
  const int used = image.width() % 64;
  return used == 0 ? ~BitImage::Word{0} : (BitImage::Word{1} << used) - 1;
}

using Word = BitImage::Word;

struct Or {
  Word operator()(Word a, Word b) const { return a | b; }
};
struct And {
  Word operator()(Word a, Word b) const { return a & b; }
};

/// Combines every pixel of a row with those `step` columns before and after it; 0 < step < 64.
template <class Combine>
void combine_columns(const Word* source, Word* target, int words, int step, Combine combine) {
  Word before = 0, here = source[0];
  for (int i = 0; i < words; ++i) {
    const Word after = i + 1 < words ? source[i + 1] : 0;
    const Word left = here << step | before >> (64 - step);
    const Word right = here >> step | after << (64 - step);
    target[i] = combine(here, combine(left, right));
    before = here, here = after;
  }
}

/// Combines every row with those `step` before and after it; rows outside the image are empty.
template <class Combine>
void combine_rows(const BitImage& source, BitImage& target, int top, int bottom, int step,
                  Combine combine) {
  const int words = source.words_per_row();
  const std::vector<Word> empty(static_cast<std::size_t>(words), 0);
  for (int y = top; y < bottom; ++y) {
    const Word* before = y >= step ? source.row(y - step) : empty.data();
    const Word* after = y + step < source.height() ? source.row(y + step) : empty.data();
    for (int i = 0; i < words; ++i)
      target.row(y)[i] = combine(source.row(y)[i], combine(before[i], after[i]));
  }
}

/// Combines every pixel with its box: a window that reaches k pixels grows by up to 2 k + 1 when it
/// is combined with itself to either side.
template <class Combine>
BitImage combine_box(BitImage image, int rx, int ry, Combine combine) {
  BitImage next(image.width(), image.height());
  const PixelBox box = bounding_box(image);
  int top = box.top, bottom = box.bottom;
  for (int reach = 0, step = 0; reach < rx; reach += step) {
    step = std::min({2 * reach + 1, rx - reach, 63});
    for (int y = top; y < bottom; ++y)
      combine_columns(image.row(y), next.row(y), image.words_per_row(), step, combine);
    std::swap(image, next);
  }
  top = std::max(top - ry, 0), bottom = std::min(bottom + ry, image.height());
  for (int reach = 0, step = 0; reach < ry; reach += step) {
    step = std::min(2 * reach + 1, ry - reach);
    combine_rows(image, next, top, bottom, step, combine);
    std::swap(image, next);
  }
  for (int y = top; y < bottom; ++y)
    image.row(y)[image.words_per_row() - 1] &= last_word_mask(image);
  return image;
}

}  // namespace

PixelBox bounding_box(const BitImage& image) {
  std::vector<BitImage::Word> columns(static_cast<std::size_t>(image.words_per_row()), 0);
  PixelBox box{0, 0, image.height(), 0};
  for (int y = 0; y < image.height(); ++y) {
    BitImage::Word any = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
      any |= image.row(y)[i], columns[i] |= image.row(y)[i];
    if (any != 0) box.top = std::min(box.top, y), box.bottom = y + 1;
  }
  if (box.bottom == 0) return {};
  const auto is_set = [](BitImage::Word any) { return any != 0; };
  const auto first = std::find_if(columns.begin(), columns.end(), is_set);
  const auto last = std::find_if(columns.rbegin(), columns.rend(), is_set);
  box.left = static_cast<int>(64 * (first - columns.begin())) + std::countr_zero(*first);
  box.right = static_cast<int>(64 * (columns.rend() - last)) - std::countl_zero(*last);
  return box;
}

std::size_t count(const BitImage& image) {
  std::size_t sum = 0;
  for (const auto word : image.words()) sum += static_cast<std::size_t>(std::popcount(word));
  return sum;
}

BitImage complement(const BitImage& image) {
  BitImage result(image.width(), image.height());
  const int words = image.words_per_row();
  for (int y = 0; y < image.height() && words > 0; ++y) {
    for (int i = 0; i < words; ++i) result.row(y)[i] = ~image.row(y)[i];
    result.row(y)[words - 1] &= last_word_mask(image);
  }
  return result;
}

BitImage united(BitImage a, const BitImage& b) {
  for (std::size_t i = 0; i < a.words().size(); ++i) a.words()[i] |= b.words()[i];
  return a;
}

BitImage without(BitImage a, const BitImage& b) {
  for (std::size_t i = 0; i < a.words().size(); ++i) a.words()[i] &= ~b.words()[i];
  return a;
}

BitImage dilate(const BitImage& image, double radius) {
  BitImage result(image.width(), image.height());
  const int words = image.words_per_row(), reach = static_cast<int>(radius);
  std::vector<BitImage::Word> row(static_cast<std::size_t>(words)), before;
  for (int y = 0; y < image.height(); ++y) {
    std::copy_n(image.row(y), words, row.begin());
    if (std::all_of(row.begin(), row.end(), [](BitImage::Word w) { return w == 0; })) continue;
    int half = 0;  // the row is widened by so much on each side
    for (int dy = reach; dy >= 0; --dy) {
      const int wanted = static_cast<int>(std::sqrt(radius * radius - dy * dy));
      widen(row, before, half, wanted);
      half = wanted;
      for (const int to : {y - dy, y + dy})
        if (to >= 0 && to < image.height())
          for (int i = 0; i < words; ++i) result.row(to)[i] |= row[static_cast<std::size_t>(i)];
    }
  }
  for (int y = 0; y < image.height() && words > 0; ++y)
    result.row(y)[words - 1] &= last_word_mask(image);
  return result;
}

BitImage dilate_box(const BitImage& image, int rx, int ry) {
  return combine_box(image, rx, ry, Or{});
}

BitImage erode_box(const BitImage& image, int rx, int ry) {
  return combine_box(image, rx, ry, And{});
}

}  // namespace marrow
