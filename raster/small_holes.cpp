#include <marrow/distance_transform.hpp>
#include <marrow/silhouette.hpp>

#include <algorithm>
#include <bit>
#include <utility>

namespace marrow {

namespace {

using Word = BitImage::Word;

/// `seeds` spread through the pixels of `open` towards higher columns.
Word spread_up(Word seeds, Word open) {
  for (int step = 1; step < 64; step *= 2) {
    seeds |= open & seeds << step;
    open &= open << step;
  }
  return seeds;
}

Word spread_down(Word seeds, Word open) {
  for (int step = 1; step < 64; step *= 2) {
    seeds |= open & seeds >> step;
    open &= open >> step;
  }
  return seeds;
}

/// Spreads `reached` along a row of `open`.
void spread_along(Word* reached, const Word* open, int words) {
  Word carry = 0;
  for (int i = 0; i < words; ++i) {
    reached[i] = spread_up(reached[i] | (open[i] & carry), open[i]);
    carry = reached[i] >> 63;
  }
  carry = 0;
  for (int i = words - 1; i >= 0; --i) {
    reached[i] = spread_down(reached[i] | (open[i] & carry), open[i]);
    carry = reached[i] << 63;
  }
}

/// Takes into a row what is reached in the row beside it; whether that is anything.
bool enter_row(Word* reached, const Word* beside, const Word* open, int words) {
  Word entered = 0;
  for (int i = 0; i < words; ++i) {
    const Word next = reached[i] | (open[i] & beside[i]);
    entered |= next ^ reached[i];
    reached[i] = next;
  }
  return entered != 0;
}

/// The pixels of `open` that steps along rows and columns reach from the edge of the image.
BitImage reached_from_edge(const BitImage& open) {
  const int width = open.width(), height = open.height(), words = open.words_per_row();
  BitImage reached(width, height);
  for (int y = 0; y < height; ++y) {
    if (open(0, y)) reached.set(0, y);
    if (open(width - 1, y)) reached.set(width - 1, y);
  }
  for (const int y : {0, height - 1}) std::copy_n(open.row(y), words, reached.row(y));
  for (int y = 0; y < height; ++y) spread_along(reached.row(y), open.row(y), words);
  const auto spread = [&](int y, int beside) {
    const bool entered = enter_row(reached.row(y), reached.row(beside), open.row(y), words);
    if (entered) spread_along(reached.row(y), open.row(y), words);
    return entered;
  };
  for (bool grown = true; grown;) {
    grown = false;
    for (int y = 1; y < height; ++y) grown |= spread(y, y - 1);
    for (int y = height - 2; y >= 0; --y) grown |= spread(y, y + 1);
  }
  return reached;
}

/// The background of `mask` that does not reach the edge of the image.
BitImage enclosed_by(const BitImage& mask) {
  const BitImage background = complement(mask);
  return without(background, reached_from_edge(background));
}

using Pixels = std::vector<std::pair<int, int>>;

/// Takes the part of `open` that holds a pixel out of it, into `part`.
void take_part(BitImage& open, int x0, int y0, Pixels& part) {
  part.assign(1, {x0, y0});
  open.clear(x0, y0);
  for (std::size_t k = 0; k < part.size(); ++k) {
    const auto [x, y] = part[k];
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (open(x + dx, y + dy)) {
        open.clear(x + dx, y + dy);
        part.push_back({x + dx, y + dy});
      }
  }
}

}  // namespace

void fill_small_holes(BitImage& mask, double radius) {
  if (mask.width() == 0 || mask.height() == 0) return;
  BitImage open = enclosed_by(mask);
  const PixelBox box = bounding_box(open);
  if (box == PixelBox{}) return;
  // To the other side of a hole's corner it is farther than to the mask around it.
  const DistanceMap depth = distance_transform(open);
  Pixels part;
  for (int y = box.top; y < box.bottom; ++y)
    for (int i = 0; i < open.words_per_row(); ++i)
      while (const Word word = open.row(y)[i]) {
        take_part(open, 64 * i + std::countr_zero(word), y, part);
        ChamferDistance deepest = 0;
        for (const auto& [px, py] : part) deepest = std::max(deepest, depth(px, py));
        if (pixels_of(deepest) < radius)
          for (const auto& [px, py] : part) mask.set(px, py);
      }
}

}  // namespace marrow
