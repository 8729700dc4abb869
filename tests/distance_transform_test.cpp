#include <marrow/distance_transform.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "random.hpp"
#include "simd_targets.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// Steps of 3 and 4 from the background until nothing gets less.
DistanceMap slow_transform(const BitImage& silhouette) {
  const int width = silhouette.width(), height = silhouette.height();
  DistanceMap map(width, height, 60000);
  const auto at = [&](int x, int y) -> int {
    return silhouette.contains(x, y) && silhouette(x, y) ? map(x, y) : 0;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        int least = at(x, y);
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int step = dx == 0 && dy == 0 ? 0 : dx == 0 || dy == 0 ? 3 : 4;
            least = std::min(least, at(x + dx, y + dy) + step);
          }
        changed |= least != map(x, y);
        map(x, y) = static_cast<ChamferDistance>(least);
      }
  }
  return map;
}

BitImage random_silhouette(Random& random, int width, int height, std::uint32_t one_hole_in) {
  BitImage silhouette(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (random.below(one_hole_in) != 0) silhouette.set(x, y);
  return silhouette;
}

int below(Random& random, int n) {
  return static_cast<int>(random.below(static_cast<std::uint32_t>(n)));
}

PixelBox random_box(Random& random, int width, int height) {
  PixelBox box{below(random, width), 0, below(random, height), 0};
  box.right = box.left + 1 + below(random, width - box.left);
  box.bottom = box.top + 1 + below(random, height - box.top);
  return box;
}

BitImage filled_outside(BitImage image, const PixelBox& box) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (x < box.left || x >= box.right || y < box.top || y >= box.bottom) image.set(x, y);
  return image;
}

}  // namespace

TEST_CASE("distance transform: as the definition says, on every instruction set") {
  on_each_simd_target([] {
    Random random(1);
    for (int i = 0; i < 120; ++i) {
      const int width = 1 + below(random, 90), height = 1 + below(random, 70);
      const std::uint32_t one_in = 2 + random.below(300);
      const BitImage silhouette = random_silhouette(random, width, height, one_in);
      INFO(width << " x " << height << ", a hole in " << one_in);
      CHECK(distance_transform(silhouette) == slow_transform(silhouette));
    }
  });
}

TEST_CASE("distance transform: in a box, as if all were silhouette around it") {
  on_each_simd_target([] {
    Random random(2);
    for (int i = 0; i < 120; ++i) {
      const int width = 1 + below(random, 90), height = 1 + below(random, 70);
      const PixelBox box = random_box(random, width, height);
      const BitImage silhouette =
          filled_outside(random_silhouette(random, width, height, 2 + random.below(300)), box);
      const BoxedDistanceMap map = distance_transform(silhouette, box);
      const DistanceMap slow = slow_transform(silhouette);
      INFO(width << " x " << height << ", box from " << box.left << ", " << box.top << " to "
                 << box.right << ", " << box.bottom);
      int wrong = 0;
      for (int y = -1; y <= height; ++y)
        for (int x = -1; x <= width; ++x) {
          const PixelBox& given = map.box();
          const bool is_inside =
              x >= given.left && x < given.right && y >= given.top && y < given.bottom;
          wrong += map(x, y) != (is_inside ? slow(x, y) : 0xffff);
        }
      CHECK(wrong == 0);
      CHECK((map.box().left <= box.left && map.box().right >= box.right));
      CHECK((map.box().top == box.top && map.box().bottom == box.bottom));
    }
  });
}

TEST_CASE("distance transform: 0 outside, 3 at the border, the edge of the image is one") {
  CHECK(distance_transform(BitImage(20, 10)) == DistanceMap(20, 10, 0));
  CHECK(distance_transform(BitImage()) == DistanceMap());
  const DistanceMap full = distance_transform(complement(BitImage(21, 11)));
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 21; ++x) CHECK(full(x, y) == 3 * (1 + std::min({x, y, 20 - x, 10 - y})));
  BitImage diamond(9, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x)
      if (std::abs(x - 4) + std::abs(y - 4) <= 2) diamond.set(x, y);
  const DistanceMap map = distance_transform(diamond);
  CHECK(map(4, 2) == 3);
  CHECK(map(5, 5) == 3);
  CHECK(map(4, 3) == 4);  // the nearest background is a diagonal step away
  CHECK(map(4, 4) == 7);
}

TEST_CASE("distance transform: the largest image does not overflow") {
  on_each_simd_target([] {
    const DistanceMap map = distance_transform(complement(BitImage(4096, 4096)));
    CHECK(map(2047, 2048) == 3 * 2048);
    CHECK(map(4000, 2048) == 3 * 96);
  });
}

TEST_CASE("distance transform: within six in a hundred of the Euclidean distance") {
  BitImage silhouette(201, 201);
  silhouette = complement(silhouette);
  silhouette.clear(100, 100);
  const DistanceMap map = distance_transform(silhouette);
  for (int y = 70; y <= 130; ++y)
    for (int x = 70; x <= 130; ++x)
      CHECK(std::abs(map(x, y) / 3.0 - std::hypot(x - 100, y - 100)) <=
            0.06 * std::hypot(x - 100, y - 100) + 1e-9);
}

TEST_CASE("pixels_of: a single pixel has a disc of half a pixel") {
  CHECK(pixels_of(3) == 0.5);
  CHECK(pixels_of(9) == 2.5);
}
