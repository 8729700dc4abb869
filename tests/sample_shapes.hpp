// Small shapes, and ways to write a shape differently.
#pragma once

#include <marrow/shape.hpp>

#include <algorithm>
#include <map>

#include "random.hpp"

namespace marrow::test {

/// A closed box about the origin; all faces outwards.
inline Shape make_box(const Vec3& half) {
  Shape s;
  for (unsigned i = 0; i < 8; ++i)
    s.points.push_back(
        {i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

/// A closed ellipsoid: the octahedron, each face cut in four `levels` times.
inline Shape make_ellipsoid(const Vec3& half, int levels) {
  Shape s{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}};
  for (unsigned i = 0; i < 8; ++i) {
    const Triangle t{i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1)};
    const bool is_mirrored = ((i ^ i >> 1 ^ i >> 2) & 1) != 0;
    s.triangles.push_back(is_mirrored ? Triangle{t[0], t[2], t[1]} : t);
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto next = static_cast<std::uint32_t>(s.points.size());
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), next);
      if (is_new) s.points.push_back(normalized(s.points[a] + s.points[b]));
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangles = finer;
  }
  for (Vec3& p : s.points) p = {p.x * half.x, p.y * half.y, p.z * half.z};
  return s;
}

/// Any triangles: nothing closes.
inline Shape make_soup(Random& random, std::uint32_t points, std::size_t triangles) {
  Shape s;
  for (std::uint32_t i = 0; i < points; ++i) s.points.push_back(random.vector());
  for (std::size_t i = 0; i < triangles; ++i)
    s.triangles.push_back({random.below(points), random.below(points), random.below(points)});
  return s;
}

inline Shape moved(Shape shape, const Frame& frame, const Vec3& origin = {}, double scale = 1) {
  for (Vec3& p : shape.points) p = origin + from_frame(frame, p) * scale;
  return shape;
}

/// The same surface with its points, faces and corners in another order; corners are turned round
/// or, with `flip`, swapped.
inline Shape reordered(const Shape& shape, Random& random, bool flip = true) {
  std::vector<std::uint32_t> order(shape.points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  random.shuffle(order);
  Shape s;
  s.points.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) s.points[order[i]] = shape.points[i];
  for (const Triangle& t : shape.triangles) {
    const std::uint32_t turn = random.below(3);
    Triangle r{order[t[turn]], order[t[(turn + 1) % 3]], order[t[(turn + 2) % 3]]};
    if (flip && random.below(2) == 1) std::swap(r[0], r[1]);
    s.triangles.push_back(r);
  }
  random.shuffle(s.triangles);
  return s;
}

/// Every triangle with points of its own.
inline Shape unwelded(const Shape& shape) {
  Shape s;
  for (const Triangle& t : shape.triangles) {
    const auto first = static_cast<std::uint32_t>(s.points.size());
    for (const auto i : t) s.points.push_back(shape.points[i]);
    s.triangles.push_back({first, first + 1, first + 2});
  }
  return s;
}

/// Every triangle the other way round.
inline Shape flipped(Shape shape) {
  for (Triangle& t : shape.triangles) std::swap(t[0], t[1]);
  return shape;
}

/// Every triangle twice.
inline Shape doubled(Shape shape) {
  const std::vector<Triangle> once = shape.triangles;
  shape.triangles.insert(shape.triangles.end(), once.begin(), once.end());
  return shape;
}

}  // namespace marrow::test
