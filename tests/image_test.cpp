#include <marrow/image.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

BitImage random_image(Random& random, int width, int height, std::uint32_t one_in) {
  BitImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (random.below(one_in) == 0) image.set(x, y);
  return image;
}

BitImage slowly_dilated(const BitImage& image, double radius) {
  BitImage result(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      if (!image(x, y)) continue;
      const int reach = static_cast<int>(std::ceil(radius));
      for (int ty = std::max(0, y - reach); ty <= std::min(image.height() - 1, y + reach); ++ty)
        for (int tx = std::max(0, x - reach); tx <= std::min(image.width() - 1, x + reach); ++tx)
          if ((tx - x) * (tx - x) + (ty - y) * (ty - y) <= radius * radius) result.set(tx, ty);
    }
  return result;
}

/// Bits past the width are zero, or equal images would not compare equal.
bool is_clean(const BitImage& image) {
  BitImage copy(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (image(x, y)) copy.set(x, y);
  return copy == image;
}

constexpr int kWidths[] = {1, 7, 63, 64, 65, 100, 128, 130, 200, 257};

}  // namespace

TEST_CASE("image: holds a value per pixel, row by row") {
  Image<int> image(5, 3, 7);
  CHECK(image.width() == 5);
  CHECK(image.height() == 3);
  CHECK(image.pixels().size() == 15);
  CHECK(std::all_of(image.pixels().begin(), image.pixels().end(), [](int v) { return v == 7; }));
  image(4, 1) = 1;
  CHECK(image.pixels()[9] == 1);
  CHECK(image.row(1)[4] == 1);
  CHECK_FALSE(image == Image<int>(5, 3, 7));
  CHECK(Image<int>().pixels().empty());
}

TEST_CASE("bit image: sets and clears single pixels") {
  for (const int width : kWidths) {
    BitImage image(width, 4);
    CHECK(image.words_per_row() == (width + 63) / 64);
    CHECK(count(image) == 0);
    for (int x = 0; x < width; ++x) {
      image.set(x, 2);
      CHECK(image(x, 2));
      CHECK(count(image) == 1);
      CHECK_FALSE(image(x, 1));
      image.clear(x, 2);
    }
    CHECK(image == BitImage(width, 4));
    CHECK(image.contains(0, 0));
    CHECK(image.contains(width - 1, 3));
    CHECK_FALSE(image.contains(width, 3));
    CHECK_FALSE(image.contains(0, 4));
    CHECK_FALSE(image.contains(-1, 0));
    CHECK_FALSE(image.contains(0, -1));
  }
}

TEST_CASE("complement: what is not set, and nothing past the width") {
  Random random(1);
  for (const int width : kWidths) {
    const BitImage image = random_image(random, width, 9, 3);
    const BitImage other = complement(image);
    CHECK(is_clean(other));
    CHECK(count(image) + count(other) == static_cast<std::size_t>(width) * 9);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < width; ++x) CHECK(image(x, y) != other(x, y));
    CHECK(complement(other) == image);
  }
  CHECK(complement(BitImage()) == BitImage());
}

TEST_CASE("dilate: as the definition says") {
  Random random(2);
  for (const int width : kWidths) {
    for (const double radius : {0.0, 0.9, 1.0, 1.5, 2.0, 5.0, 7.3, 63.0, 64.0, 70.0, 150.0}) {
      const BitImage image = random_image(random, width, 40, radius < 4 ? 20 : 900);
      const BitImage dilated = dilate(image, radius);
      INFO("width " << width << ", radius " << radius);
      CHECK(dilated == slowly_dilated(image, radius));
      CHECK(is_clean(dilated));
    }
  }
}

TEST_CASE("dilate: nothing, next to nothing, and everything") {
  Random random(3);
  const BitImage image = random_image(random, 77, 50, 5);
  CHECK(dilate(image, 0) == image);
  CHECK(dilate(BitImage(77, 50), 9) == BitImage(77, 50));
  CHECK(dilate(image, 200) == complement(BitImage(77, 50)));
  CHECK(dilate(BitImage(), 2) == BitImage());
  BitImage corner(200, 200);
  corner.set(0, 0);
  CHECK(count(dilate(corner, 1)) == 3);
  CHECK(count(dilate(corner, 1.5)) == 4);
}

TEST_CASE("bounding box: the least that holds all set pixels") {
  CHECK(bounding_box(BitImage()) == PixelBox{});
  CHECK(bounding_box(BitImage(70, 9)) == PixelBox{});
  Random random(4);
  for (const int width : kWidths)
    for (const std::uint32_t one_in : {2u, 40u, 2000u}) {
      const BitImage image = random_image(random, width, 30, one_in);
      PixelBox box{width, 0, 30, 0};
      for (int y = 0; y < 30; ++y)
        for (int x = 0; x < width; ++x) {
          if (!image(x, y)) continue;
          box = {std::min(box.left, x), std::max(box.right, x + 1), std::min(box.top, y), y + 1};
        }
      INFO("width " << width << ", one in " << one_in);
      CHECK(bounding_box(image) == (count(image) == 0 ? PixelBox{} : box));
    }
}

TEST_CASE("a box of pixels: any and all", "[image]") {
  Random random(9);
  for (const auto& [width, height] : {std::pair(64, 20), {70, 33}, {131, 40}})
    for (const auto& [rx, ry] : {std::pair(0, 0), {1, 2}, {6, 5}, {3, 0}, {70, 9}}) {
      BitImage image(width, height);
      for (int i = 0; i < 3; ++i) image.set(width - 1, i);
      for (int y = 3; y < height - 4; ++y)
        for (int x = 0; x < width; ++x)
          if (random.below(100) < (x < width / 2 ? 2u : 99u)) image.set(x, y);
      const BitImage any = dilate_box(image, rx, ry), all = erode_box(image, rx, ry);
      bool same = true;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          bool some = false, every = true;
          for (int j = y - ry; j <= y + ry; ++j)
            for (int i = x - rx; i <= x + rx; ++i) {
              const bool is_set = image.contains(i, j) && image(i, j);
              some = some || is_set;
              every = every && is_set;
            }
          same = same && any(x, y) == some && all(x, y) == every;
        }
      INFO(width << " x " << height << ", box " << rx << ", " << ry);
      CHECK(same);
      CHECK(complement(complement(any)) == any);  // no bits past the width
    }
  CHECK(dilate_box(BitImage(), 2, 2) == BitImage());
}
