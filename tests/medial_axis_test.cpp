#include <marrow/medial_axis.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "catch.hpp"
#include "plain_medial_axis.hpp"
#include "random.hpp"
#include "scale.hpp"
#include "simd_targets.hpp"
#include "sure_removal_detail.hpp"
#include "thinning_detail.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

template <class Inside>
BitImage draw(int width, int height, const Inside& inside) {
  BitImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (inside(x, y)) image.set(x, y);
  return image;
}

BitImage rectangle(int size, int x0, int y0, int width, int height) {
  return draw(size, size, [=](int x, int y) {
    return x >= x0 && y >= y0 && x < x0 + width && y < y0 + height;
  });
}

bool is_near_segment(double x, double y, std::array<double, 4> s, double radius) {
  const double dx = s[2] - s[0], dy = s[3] - s[1];
  const double t = std::clamp(((x - s[0]) * dx + (y - s[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - s[0] - t * dx, y - s[1] - t * dy) <= radius;
}

/// Balls and bars thrown at random; they may lie over the edge of the image when `margin` is < 0.
BitImage random_blob(Random& random, int size, int margin) {
  BitImage image(size, size);
  const auto place = [&] { return random.between(margin, size - margin); };
  for (int i = 0; i < 7; ++i) {
    const double radius = random.between(0.6, size / 9.0);
    const std::array<double, 4> bar{place(), place(), place(), place()};
    const bool is_hole = random.below(4) == 0;
    for (int y = margin < 0 ? 0 : margin; y < std::min(size, size - margin); ++y)
      for (int x = margin < 0 ? 0 : margin; x < std::min(size, size - margin); ++x)
        if (is_near_segment(x, y, bar, radius)) is_hole ? image.clear(x, y) : image.set(x, y);
  }
  for (int i = 0; i < 40; ++i) {  // and specks
    const int x = static_cast<int>(random.below(static_cast<std::uint32_t>(size)));
    const int y = static_cast<int>(random.below(static_cast<std::uint32_t>(size)));
    if (std::min(x, y) < margin || std::max(x, y) >= size - margin) continue;
    image(x, y) ? image.clear(x, y) : image.set(x, y);
  }
  return image;
}

/// A ring, turned and bent: wide and smooth.
BitImage fat_blob(Random& random, int size) {
  const double middle = 0.5 * size, a = random.between(0.3, 0.45) * size,
               b = random.between(0.3, 0.45) * size, hole = random.between(0, 0.5);
  const Frame f = random.frame();
  return draw(size, size, [&](int x, int y) {
    const double u = (f.x.x * (x - middle) + f.x.y * (y - middle)) / a,
                 v = (f.y.x * (x - middle) + f.y.y * (y - middle)) / b, r = u * u + v * v;
    return r <= 1 && r >= hole * hole;
  });
}

std::size_t loose_count(const ShrinkingSet& set) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < set.word_count(); ++i)
    count += static_cast<std::size_t>(std::popcount(set.loose_in_word(i)));
  return count;
}

bool is_set(const BitImage& image, int x, int y) { return image.contains(x, y) && image(x, y); }

/// Parts of the pixels with `value`, the image with a rim of background around.
int count_parts(const BitImage& image, bool value, bool diagonals) {
  const int width = image.width() + 2, height = image.height() + 2;
  const auto has_value = [&](int x, int y) { return is_set(image, x - 1, y - 1) == value; };
  Image<std::uint8_t> seen(width, height, 0);
  int parts = 0;
  for (int y0 = 0; y0 < height; ++y0)
    for (int x0 = 0; x0 < width; ++x0) {
      if (seen(x0, y0) || !has_value(x0, y0)) continue;
      ++parts;
      std::vector<std::pair<int, int>> stack{{x0, y0}};
      seen(x0, y0) = 1;
      while (!stack.empty()) {
        const auto [x, y] = stack.back();
        stack.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx, ny = y + dy;
            if (!diagonals && dx != 0 && dy != 0) continue;
            if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
            if (seen(nx, ny) || !has_value(nx, ny)) continue;
            seen(nx, ny) = 1;
            stack.push_back({nx, ny});
          }
      }
    }
  return parts;
}

struct Topology {
  int parts = 0, holes = 0;

  friend bool operator==(const Topology&, const Topology&) = default;
};

Topology topology_of(const BitImage& image) {
  return {count_parts(image, true, true), count_parts(image, false, false) - 1};
}

std::ostream& operator<<(std::ostream& out, const Topology& t) {
  return out << t.parts << " parts, " << t.holes << " holes";
}

int neighbours(const BitImage& image, int x, int y) {
  int count = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) count += (dx != 0 || dy != 0) && is_set(image, x + dx, y + dy);
  return count;
}

/// Whether the topology of the 3x3 pixels is the same without the one in the middle.
bool is_removable(const BitImage& image, int x, int y) {
  BitImage patch = draw(3, 3, [&](int i, int j) { return is_set(image, x + i - 1, y + j - 1); });
  const Topology with = topology_of(patch);
  patch.clear(1, 1);
  // A hole of one pixel is not seen within the patch when its diagonal neighbours are open.
  const bool is_inner = is_set(image, x - 1, y) && is_set(image, x + 1, y) &&
                        is_set(image, x, y - 1) && is_set(image, x, y + 1);
  return !is_inner && topology_of(patch) == with;
}

struct Axis {
  DistanceMap map;
  MedialAxis axis;
  BitImage image;
};

Axis axis_of(const BitImage& silhouette, double prune_pixels = 3) {
  Axis a{distance_transform(silhouette), {}, BitImage(silhouette.width(), silhouette.height())};
  a.axis = medial_axis(a.map, prune_pixels);
  for (int y = 0; y < a.axis.rows(); ++y)
    for (const MedialPixel& p : a.axis.row(y)) a.image.set(p.x, y);
  return a;
}

int count_with_neighbours(const BitImage& image, int least, int most) {
  int result = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const int n = image(x, y) ? neighbours(image, x, y) : -1;
      result += n >= least && n <= most;
    }
  return result;
}

int ends_of(const BitImage& image) { return count_with_neighbours(image, 1, 1); }

/// Greatest distance from a pixel of `image` at which the axis has a pixel.
double farthest(const BitImage& image, double x0, double y0) {
  double result = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (image(x, y)) result = std::max(result, std::hypot(x - x0, y - y0));
  return result;
}

void check_is_thin_and_true(const BitImage& silhouette, const Axis& a) {
  CHECK(topology_of(a.image) == topology_of(silhouette));
  int removable = 0, outside = 0;
  for (int y = 0; y < a.image.height(); ++y)
    for (int x = 0; x < a.image.width(); ++x) {
      if (!a.image(x, y)) continue;
      outside += !silhouette(x, y);
      removable += neighbours(a.image, x, y) > 1 && is_removable(a.image, x, y);
    }
  CHECK(outside == 0);
  CHECK(removable == 0);
}

}  // namespace

TEST_CASE("medial axis: pixels row by row with their distances") {
  Random random(1);
  const BitImage silhouette = random_blob(random, 100, 3);
  const Axis a = axis_of(silhouette);
  REQUIRE(a.axis.rows() == 100);
  std::size_t total = 0;
  for (int y = 0; y < 100; ++y) {
    int previous = -1;
    for (const MedialPixel& p : a.axis.row(y)) {
      CHECK(p.x > previous);
      previous = p.x;
      CHECK(p.distance == a.map(p.x, y));
      CHECK(p.distance > 0);
    }
    total += a.axis.row(y).size();
  }
  CHECK(total == a.axis.pixels().size());
  CHECK(to_image(a.axis, 100) == a.image);
  CHECK(MedialAxis(a.image, a.map) == a.axis);
  CHECK(MedialAxis().rows() == 0);
}

TEST_CASE("medial axis: of nothing is nothing, of a pixel the pixel") {
  CHECK(axis_of(BitImage(40, 30)).axis.pixels().empty());
  CHECK(axis_of(BitImage(40, 30)).axis.rows() == 30);
  BitImage pixel(40, 30);
  pixel.set(7, 9);
  CHECK(axis_of(pixel).image == pixel);
}

TEST_CASE("medial axis: runs along the middle of a rectangle, lying or standing") {
  for (const int thickness : {1, 2, 3, 4, 5, 6, 7, 8, 9, 12}) {
    for (const bool is_standing : {false, true}) {
      INFO(thickness << " thick, standing " << is_standing);
      const BitImage silhouette = is_standing ? rectangle(100, 20, 10, thickness, 70)
                                              : rectangle(100, 10, 20, 70, thickness);
      const Axis a = axis_of(silhouette);
      check_is_thin_and_true(silhouette, a);
      CHECK(ends_of(a.image) == 2);
      int along = 0;
      const double middle = 20 + 0.5 * (thickness - 1);
      for (int i = 10 + thickness; i < 80 - thickness; ++i)
        for (int j = 0; j < 100; ++j) {
          if (!(is_standing ? a.image(j, i) : a.image(i, j))) continue;
          ++along;
          CHECK(std::abs(j - middle) <= 0.5);
        }
      CHECK(along == 70 - 2 * thickness);
    }
  }
}

TEST_CASE("medial axis: a disc shrinks to its centre") {
  for (const double radius : {2.0, 5.5, 12.0, 30.2}) {
    const BitImage disc =
        draw(80, 80, [=](int x, int y) { return std::hypot(x - 40, y - 40) <= radius; });
    // The chamfer metric sees an octagon: distances are off by up to 6 % either way.
    const Axis a = axis_of(disc, 3 + 0.12 * radius);
    INFO("radius " << radius);
    check_is_thin_and_true(disc, a);
    CHECK(farthest(a.image, 40, 40) <= 1 + 0.45 * radius);
    check_is_thin_and_true(disc, axis_of(disc));
  }
}

TEST_CASE("medial axis: an annulus keeps one loop without ends") {
  const auto inside = [](double r) { return r <= 30 && r >= 18; };
  const BitImage annulus =
      draw(90, 90, [&](int x, int y) { return inside(std::hypot(x - 45, y - 45)); });
  const Axis a = axis_of(annulus);
  check_is_thin_and_true(annulus, a);
  CHECK(topology_of(a.image) == Topology{1, 1});
  CHECK(ends_of(a.image) == 0);
  for (int y = 0; y < 90; ++y)
    for (const MedialPixel& p : a.axis.row(y))
      CHECK(std::abs(std::hypot(p.x - 45, y - 45) - 24) <= 2);
}

TEST_CASE("medial axis: a Y has three ends, at its tips") {
  const std::array<std::array<double, 2>, 3> tips{{{20, 20}, {100, 24}, {58, 110}}};
  const BitImage silhouette = draw(128, 128, [&](int x, int y) {
    return std::any_of(tips.begin(), tips.end(), [&](const auto& tip) {
      return is_near_segment(x, y, {60, 60, tip[0], tip[1]}, 7);
    });
  });
  const Axis a = axis_of(silhouette);
  check_is_thin_and_true(silhouette, a);
  CHECK(ends_of(a.image) == 3);
  for (const auto& tip : tips) {
    double nearest = 1e9;
    for (int y = 0; y < 128; ++y)
      for (const MedialPixel& p : a.axis.row(y))
        nearest = std::min(nearest, std::hypot(p.x - tip[0], y - tip[1]));
    CHECK(nearest <= 2);
  }
}

TEST_CASE("medial axis: pruning takes a bump and leaves a limb") {
  const auto with_limb = [](int height) {
    return draw(128, 96, [=](int x, int y) {
      const bool is_in_body = x >= 10 && x < 118 && y >= 20 && y < 41;
      return is_in_body || (x >= 60 && x < 67 && y >= 41 && y < 41 + height);
    });
  };
  const int smooth_ends = ends_of(axis_of(with_limb(0), 6).image);
  CHECK(ends_of(axis_of(with_limb(2), 6).image) == smooth_ends);
  const Axis a = axis_of(with_limb(30), 6);
  CHECK(ends_of(a.image) == smooth_ends + 1);
  int highest = 0;
  for (int y = 0; y < 96; ++y)
    if (!a.axis.row(y).empty()) highest = y;
  CHECK(highest >= 64);
  // The less is asked for, the more stays.
  CHECK(axis_of(with_limb(30), 0).axis.pixels().size() > a.axis.pixels().size());
  CHECK(axis_of(with_limb(30), 60).axis.pixels().size() < a.axis.pixels().size());
}

TEST_CASE("medial axis: has the topology of the silhouette and unit width") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const BitImage silhouette = random_blob(random, 30 + i % 50, 3);
    for (const double prune : {0.0, 3.0}) {
      INFO("blob " << i << ", prune " << prune);
      check_is_thin_and_true(silhouette, axis_of(silhouette, prune));
    }
  }
}

TEST_CASE("medial axis: a silhouette may touch the edge of the image") {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const BitImage silhouette = random_blob(random, 24 + i % 40, -3);
    INFO("blob " << i);
    check_is_thin_and_true(silhouette, axis_of(silhouette));
  }
  const BitImage full = complement(BitImage(33, 20));
  check_is_thin_and_true(full, axis_of(full));
}

TEST_CASE("medial axis: does not depend on where in the image the silhouette is") {
  Random random(4);
  const BitImage blob = random_blob(random, 60, 0);
  const BitImage inner = draw(100, 90, [&](int x, int y) { return is_set(blob, x - 20, y - 10); });
  const Axis a = axis_of(blob), b = axis_of(inner);
  CHECK(b.image == draw(100, 90, [&](int x, int y) { return is_set(a.image, x - 20, y - 10); }));
}

TEST_CASE("medial axis: the same as pixel by pixel, on every instruction set") {
  on_each_simd_target([] {
    Random random(5);
    for (int i = 0; i < scaled(200, 60); ++i) {
      const BitImage silhouette = random_blob(random, 20 + i % 110, i % 9 - 4);
      for (const double prune : {0.0, 3.0, 9.0}) {
        INFO("blob " << i << ", prune " << prune);
        const Axis a = axis_of(silhouette, prune);
        CHECK(a.image == PlainMedialAxis(a.map, prune).image());
      }
    }
  });
}

TEST_CASE("medial axis: what goes for sure may go at once, also where little does") {
  on_each_simd_target([] {
    Random random(7);
    std::size_t loose = 0, sure = 0;
    for (int i = 0; i < scaled(300, 80); ++i) {
      INFO("blob " << i);
      const DistanceMap map = distance_transform(i % 3 == 0 ? fat_blob(random, 60 + i % 90)
                                                            : random_blob(random, 20 + i % 110, 0));
      ShrinkingSet plain, sooner;
      plain.assign(map), sooner.assign(map);
      DoubtfulPixels room;
      const std::size_t before = loose_count(sooner);
      remove_sure(sooner, room, 1);
      loose += before, sure += before - loose_count(sooner);
      PixelOrder order;
      thin_to_medial_axis(plain, order), thin_to_medial_axis(sooner, order);
      CHECK(pixels(plain) == pixels(sooner));
    }
    CHECK(sure > loose / 4);
  });
}

TEST_CASE("medial axis: most of a fat part goes at once, nothing of a ragged one") {
  Random random(8);
  DoubtfulPixels room;
  const auto sure_of = [&](const BitImage& silhouette) {
    ShrinkingSet set;
    set.assign(distance_transform(silhouette));
    const auto before = static_cast<double>(loose_count(set));
    remove_sure(set, room);
    return 1 - static_cast<double>(loose_count(set)) / before;
  };
  CHECK(sure_of(fat_blob(random, 150)) > 0.5);
  CHECK(sure_of(random_blob(random, 60, 0)) == 0);
}

TEST_CASE("medial axis: the same as pixel by pixel where all is border") {
  Random random(6);
  for (int i = 0; i < scaled(300, 100); ++i) {
    const std::uint32_t one_in = 2 + random.below(9);
    const BitImage silhouette = draw(1 + static_cast<int>(random.below(130)), 40,
                                     [&](int, int) { return random.below(one_in) != 0; });
    INFO("noise " << i << ", a hole in " << one_in);
    const Axis a = axis_of(silhouette);
    CHECK(a.image == PlainMedialAxis(a.map, 3).image());
  }
}
