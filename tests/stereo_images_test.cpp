#include <marrow/stereo_images.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "sample_shapes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

NormalizedShape normalized_shape(const Shape& shape) { return apply(normalize(shape), shape); }

void check_is_frame_along(const Frame& f, const Vec3& direction) {
  for (const Vec3& axis : {f.x, f.y, f.z}) CHECK(length(axis) == Approx(1).epsilon(1e-13));
  CHECK(distance(cross(f.x, f.y), f.z) < 1e-13);
  CHECK(distance(f.z, direction) < 1e-13);
}

struct Rows {
  int first = -1, last = -1;
};

Rows rows_of(const BitImage& image) {
  Rows rows;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (image(x, y)) {
        if (rows.first < 0) rows.first = y;
        rows.last = y;
      }
  return rows;
}

Shape bent_soup() {
  Random random(1);
  Shape shape = make_ellipsoid({0.4, 1, 0.3}, 3);
  for (Vec3& p : shape.points) p.x += p.y * p.y;
  for (const Triangle& t : make_soup(random, 20, 5).triangles) shape.triangles.push_back(t);
  return shape;
}

void check_image(const ViewImage& image, const NormalizedShape& shape, const ViewPlane& plane,
                 int resolution) {
  CHECK(image.plane == plane);
  CHECK(image.silhouette == draw_silhouette(shape, plane, resolution));
  CHECK(image.distance == distance_transform(image.silhouette));
  CHECK(image.axis == medial_axis(image.distance));
  REQUIRE(image.axis.pixels().size() > 0);
  const DistanceMap to_axis = distance_transform(complement(to_image(image.axis, resolution)));
  const BitImage near = dilate(image.silhouette, 1.5);
  int wrong = 0;
  for (int y = 0; y < resolution; ++y)
    for (int x = 0; x < resolution; ++x)
      wrong += near(x, y) && image.to_axis(x, y) != to_axis(x, y);
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("stereo pair: an orthonormal frame along every direction, always the same") {
  Random random(2);
  for (const Shape& shape : {make_box({1, 3, 2}), make_box({1, 1, 1}), make_box({1, 2, 0}),
                             make_ellipsoid({1, 1, 1}, 2), bent_soup()}) {
    const NormalizedShape s = normalized_shape(shape);
    const Shape other = reordered(shape, random);
    const NormalizedShape r = apply(normalize(other), other);
    for (const Vec3& d : hemisphere_directions()) {
      const StereoPair pair = stereo_pair(s, d);
      check_is_frame_along(pair.frame, d);
      CHECK(stereo_pair(r, d).frame == pair.frame);
    }
  }
}

TEST_CASE("stereo pair: the scanline axis is the long axis of what is seen") {
  const NormalizedShape rod = normalized_shape(make_box({0.2, 3, 0.2}));
  for (const Vec3& d : hemisphere_directions()) {
    if (std::abs(d.y) > 0.9) continue;
    const Vec3 seen = normalized(Vec3{0, 1, 0} - d * d.y);
    CHECK(std::abs(dot(stereo_pair(rod, d).frame.y, seen)) > 0.995);
  }
  // In the front image the extent along y is the greatest of all directions.
  const NormalizedShape slab = normalized_shape(make_box({1, 2.5, 0.3}));
  for (const Vec3& d : hemisphere_directions()) {
    const Frame f = stereo_pair(slab, d).frame;
    double along_x = 0, along_y = 0;
    for (std::size_t i = 0; i < slab.x.size(); ++i) {
      const Vec3 q = to_frame(f, {slab.x[i], slab.y[i], slab.z[i]});
      along_x = std::max(along_x, std::abs(q.x));
      along_y = std::max(along_y, std::abs(q.y));
    }
    CHECK(along_y > along_x);
  }
}

TEST_CASE("stereo pair: a plate seen from its edge") {
  const NormalizedShape plate = normalized_shape(make_box({1, 2.5, 0}));  // z is its normal
  for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
    const StereoPair pair = stereo_pair(plate, d);
    check_is_frame_along(pair.frame, d);
    CHECK(std::abs(pair.frame.y.z) < 1e-3);
    const StereoImages images = draw_stereo_images(plate, pair, 64);
    CHECK(count(images.front.silhouette) > 15);
    CHECK(images.front.axis.pixels().size() > 15);
    CHECK(images.side.axis.pixels().size() > 0);
  }
}

TEST_CASE("stereo images: all that belongs to an image") {
  const NormalizedShape shape = normalized_shape(bent_soup());
  const StereoPair pair = stereo_pair(shape, hemisphere_directions()[13]);
  const StereoImages images = draw_stereo_images(shape, pair, 100);
  CHECK(images.pair.frame == pair.frame);
  check_image(images.front, shape, pair.front(), 100);
  check_image(images.side, shape, pair.side(), 100);
}

TEST_CASE("stereo images: both see the shape in the same rows") {
  for (const Shape& shape : {make_box({1, 3, 2}), make_ellipsoid({0.3, 1, 0.5}, 3), bent_soup()}) {
    const NormalizedShape s = normalized_shape(shape);
    for (const Vec3& d : hemisphere_directions()) {
      const StereoImages images = draw_stereo_images(s, stereo_pair(s, d), 128);
      const Rows front = rows_of(images.front.silhouette), side = rows_of(images.side.silhouette);
      CHECK(front.first >= 2);
      CHECK(front.last <= 125);
      CHECK(std::abs(front.first - side.first) <= 1);
      CHECK(std::abs(front.last - side.last) <= 1);
    }
  }
}
