#include <marrow/distance_transform.hpp>
#include <marrow/silhouette.hpp>

#include <algorithm>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Every part of the background, pixel by pixel, with its depth in all of the background.
BitImage slowly_filled(BitImage mask, double radius) {
  const DistanceMap depth = distance_transform(complement(mask));
  BitImage open = complement(mask);
  for (int y0 = 0; y0 < mask.height(); ++y0)
    for (int x0 = 0; x0 < mask.width(); ++x0) {
      if (!open(x0, y0)) continue;
      std::vector<std::pair<int, int>> part{{x0, y0}};
      open.clear(x0, y0);
      bool enclosed = true;
      ChamferDistance deepest = 0;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto [x, y] = part[k];
        deepest = std::max(deepest, depth(x, y));
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!open.contains(x + dx, y + dy))
            enclosed = false;
          else if (open(x + dx, y + dy)) {
            open.clear(x + dx, y + dy);
            part.push_back({x + dx, y + dy});
          }
        }
      }
      if (enclosed && pixels_of(deepest) < radius)
        for (const auto& [x, y] : part) mask.set(x, y);
    }
  return mask;
}

/// Boxes of background and of mask, one over the other, and specks of both.
BitImage random_mask(Random& random, int width, int height) {
  BitImage mask(width, height);
  const auto below = [&](int n) {
    return static_cast<int>(random.below(static_cast<std::uint32_t>(n)));
  };
  for (int i = below(30); i > 0; --i) {
    const int x0 = below(width), y0 = below(height), side = i % 4 == 0 ? 40 : 8;
    const int x1 = std::min(width, x0 + 1 + below(side)), y1 = std::min(height, y0 + below(side));
    const bool value = below(2) == 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) value ? mask.set(x, y) : mask.clear(x, y);
  }
  const int one_in = 2 + below(60);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (below(one_in) == 0) mask(x, y) ? mask.clear(x, y) : mask.set(x, y);
  return mask;
}

}  // namespace

TEST_CASE("small holes: the same as pixel by pixel") {
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const int width = 1 + static_cast<int>(random.below(200));
    const BitImage mask = random_mask(random, width, 1 + static_cast<int>(random.below(60)));
    for (const double radius : {0.4, 0.6, 1.2, 2.0, 4.0, 100.0}) {
      INFO("mask " << i << ", " << width << " wide, radius " << radius);
      BitImage filled = mask;
      fill_small_holes(filled, radius);
      CHECK(filled == slowly_filled(mask, radius));
    }
  }
}

TEST_CASE("small holes: a spiral leads out, a closed one does not") {
  BitImage mask(200, 90);
  for (int ring = 0; ring < 20; ++ring)
    for (int y = 2 * ring; y < 90 - 2 * ring; ++y)
      for (int x = 2 * ring; x < 200 - 2 * ring; ++x)
        if (x == 2 * ring || y == 2 * ring || x == 199 - 2 * ring || y == 89 - 2 * ring)
          mask.set(x, y);
  const BitImage closed = mask;
  for (int ring = 0; ring < 20; ++ring)  // a gap in every wall, far from that in the one before
    ring % 2 == 0 ? mask.clear(2 * ring, 45) : mask.clear(199 - 2 * ring, 44);
  BitImage filled = mask;
  fill_small_holes(filled, 100);
  CHECK(filled == mask);
  filled = closed;
  fill_small_holes(filled, 100);
  CHECK(count(filled) == 200 * 90);
  fill_small_holes(filled, 100);
  CHECK(count(filled) == 200 * 90);
  BitImage nothing;
  fill_small_holes(nothing, 5);
  CHECK(nothing == BitImage());
}
