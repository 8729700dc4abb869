#include <marrow/image.hpp>

#include <bit>
#include <cmath>

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

/// The bits of a row's last word that lie in the image.
BitImage::Word last_word_mask(const BitImage& image) {
  const int used = image.width() % 64;
  return used == 0 ? ~BitImage::Word{0} : (BitImage::Word{1} << used) - 1;
}

}  // namespace

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

BitImage dilate(const BitImage& image, double radius) {
  BitImage result(image.width(), image.height());
  const int reach = static_cast<int>(radius);
  for (int dy = -reach; dy <= reach; ++dy) {
    const int half = static_cast<int>(std::sqrt(radius * radius - dy * dy));
    for (int y = 0; y < image.height(); ++y) {
      const int from = y + dy;
      if (from < 0 || from >= image.height()) continue;
      for (int dx = -half; dx <= half; ++dx)
        or_shifted(result.row(y), image.row(from), image.words_per_row(), dx);
      if (image.words_per_row() > 0)
        result.row(y)[image.words_per_row() - 1] &= last_word_mask(image);
    }
  }
  return result;
}

}  // namespace marrow
