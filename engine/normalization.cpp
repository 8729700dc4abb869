#include <marrow/error.hpp>
#include <marrow/normalization.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "eigen_detail.hpp"

namespace marrow {

namespace {

__extension__ using Int128 = __int128;

constexpr double kLattice = 1 << 20;  // cells along the longest side, for exact sums
constexpr double kSameMoment = 1e-5;  // relative gap under which two moments coincide
constexpr double kNoSkew = 1e-4;      // third moment, relative, under which it vanishes

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = -low;

  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3 center() const { return (low + high) * 0.5; }
  double longest() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

std::vector<bool> used_points(const Shape& shape) {
  std::vector<bool> used(shape.points.size(), false);
  for (const auto& t : shape.triangles)
    for (const auto i : t) used[i] = true;
  return used;
}

/// A power of two that brings the largest used coordinate near 1.
double prescale_of(const Shape& shape, const std::vector<bool>& used) {
  double largest = 0;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    if (!used[i]) continue;
    const Vec3& p = shape.points[i];
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  if (largest == 0) return 1;
  return std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1020, 1020));
}

struct LatticePoint {
  std::int64_t x, y, z;
};

/// Area-weighted sums over the surface of 1, x and x xᵀ in lattice units; integers, so that any
/// order of triangles and corners gives the same.
struct Moments {
  Int128 area = 0;
  std::array<Int128, 3> first{};
  std::array<Int128, 6> second{};  // xx, yy, zz, xy, xz, yz

  void add(double weight, std::int64_t x, std::int64_t y, std::int64_t z,
           const std::array<std::int64_t, 6>& products) {
    area += std::llrint(weight * 0x1p10);
    first[0] += std::llrint(weight * static_cast<double>(x) * 0x1p-10);
    first[1] += std::llrint(weight * static_cast<double>(y) * 0x1p-10);
    first[2] += std::llrint(weight * static_cast<double>(z) * 0x1p-10);
    for (std::size_t i = 0; i < 6; ++i)
      second[i] += std::llrint(weight * static_cast<double>(products[i]) * 0x1p-30);
  }
};

double twice_area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  const std::int64_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const std::int64_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const auto nx = static_cast<double>(uy * vz - uz * vy);
  const auto ny = static_cast<double>(uz * vx - ux * vz);
  const auto nz = static_cast<double>(ux * vy - uy * vx);
  return std::sqrt(nx * nx + ny * ny + nz * nz);
}

void add_triangle(Moments& m, double weight, const LatticePoint& a, const LatticePoint& b,
                  const LatticePoint& c) {
  const std::int64_t sx = a.x + b.x + c.x, sy = a.y + b.y + c.y, sz = a.z + b.z + c.z;
  m.add(weight, sx, sy, sz,
        {a.x * a.x + b.x * b.x + c.x * c.x + sx * sx, a.y * a.y + b.y * b.y + c.y * c.y + sy * sy,
         a.z * a.z + b.z * b.z + c.z * c.z + sz * sz, a.x * a.y + b.x * b.y + c.x * c.y + sx * sy,
         a.x * a.z + b.x * b.z + c.x * c.z + sx * sz, a.y * a.z + b.y * b.z + c.y * c.z + sy * sz});
}

struct Covariance {
  Vec3 mean;  // lattice units
  SymmetricMatrix matrix;
};

Covariance covariance_of(const Moments& m) {
  const double area = static_cast<double>(m.area) * 0x1p-10;
  const auto first = [&](std::size_t i) {
    return static_cast<double>(m.first[i]) * 0x1p10 / (3 * area);
  };
  const Vec3 mean{first(0), first(1), first(2)};
  const auto second = [&](std::size_t i) {
    return static_cast<double>(m.second[i]) * 0x1p30 / (12 * area);
  };
  return {mean,
          {second(0) - mean.x * mean.x, second(1) - mean.y * mean.y, second(2) - mean.z * mean.z,
           second(3) - mean.x * mean.y, second(4) - mean.x * mean.z, second(5) - mean.y * mean.z}};
}

/// Sum over the surface of weight times the third moment of s along a triangle with corner values
/// a, b, c; `sum` in units of kLattice³.
void add_skew(Int128& sum, double weight, std::array<double, 3> s) {
  std::sort(s.begin(), s.end());  // so that the order of corners does not matter
  const auto [a, b, c] = s;
  const double cubic = a * a * a + b * b * b + c * c * c + a * a * b + a * a * c + b * b * a +
                       b * b * c + c * c * a + c * c * b + a * b * c;
  sum += std::llrint(weight * cubic * 0x1p-60 * 0x1p10);
}

/// The surface on an integer lattice, for sums that no order can change.
class LatticeSurface {
 public:
  LatticeSurface(const Shape& shape, const std::vector<bool>& used, double prescale, const Box& box)
      : shape_(shape), points_(shape.points.size()) {
    const double scale = kLattice / box.longest();
    const Vec3 center = box.center();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!used[i]) continue;
      const Vec3 q = (shape.points[i] * prescale - center) * scale;
      points_[i] = {std::llrint(q.x), std::llrint(q.y), std::llrint(q.z)};
    }
    double total = 0;
    for (const auto& t : shape.triangles) total += area(t);
    // Needles only: their edges weigh instead of their areas.
    by_area_ = total > 0;
  }

  Covariance covariance() const {
    Moments m;
    for (const auto& t : shape_.triangles)
      add_triangle(m, weight(t), points_[t[0]], points_[t[1]], points_[t[2]]);
    return covariance_of(m);
  }

  /// Third moment along `axis` relative to the spread along it.
  double skew(const Vec3& mean, const Vec3& axis, double variance) const {
    Int128 sum = 0, area_sum = 0;
    for (const auto& t : shape_.triangles) {
      const double w = weight(t);
      area_sum += std::llrint(w * 0x1p10);
      add_skew(sum, w, {along(t[0], mean, axis), along(t[1], mean, axis), along(t[2], mean, axis)});
    }
    const double third = static_cast<double>(sum) * 0x1p60 / (10 * static_cast<double>(area_sum));
    return third / (variance * std::sqrt(variance));
  }

 private:
  double area(const Triangle& t) const {
    return twice_area(points_[t[0]], points_[t[1]], points_[t[2]]);
  }
  double weight(const Triangle& t) const {
    if (by_area_) return area(t);
    const auto squared = [](const LatticePoint& a, const LatticePoint& b) {
      return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z);
    };
    const auto &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    return std::sqrt(static_cast<double>(squared(a, b) + squared(b, c) + squared(c, a)));
  }
  double along(std::uint32_t i, const Vec3& mean, const Vec3& axis) const {
    const LatticePoint& p = points_[i];
    return dot(
        Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)} - mean,
        axis);
  }

  const Shape& shape_;
  std::vector<LatticePoint> points_;
  bool by_area_ = true;
};

/// The input axis that `subspace` (an orthogonal complement given by its normal, or all of space
/// for a zero normal) holds best, projected into it.
Vec3 best_input_axis(const Vec3& normal) {
  Vec3 best;
  double longest = -1;
  for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 inside = e - normal * dot(normal, e);
    if (squared_length(inside) > longest + 1e-9) longest = squared_length(inside), best = inside;
  }
  return normalized(best);
}

/// Directions of greatest, middle and least spread, before signs; ties by the input axes.
std::array<Vec3, 3> principal_axes(const Eigensystem& e) {
  const double gap = kSameMoment * std::max(e.values[0], 1e-300);
  const bool first_tie = e.values[0] - e.values[1] <= gap;
  const bool second_tie = e.values[1] - e.values[2] <= gap;
  if (first_tie && second_tie) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  if (first_tie) {
    const Vec3 a = best_input_axis(e.vectors[2]);
    return {a, cross(e.vectors[2], a), e.vectors[2]};
  }
  if (second_tie) {
    const Vec3 b = best_input_axis(e.vectors[0]);
    return {e.vectors[0], b, cross(e.vectors[0], b)};
  }
  return e.vectors;
}

Vec3 with_greatest_component_positive(const Vec3& v) {
  // Two components may be equal up to rounding: a later one must be clearly greater.
  double greatest = v.x;
  for (const double c : {v.y, v.z})
    if (std::abs(c) > std::abs(greatest) + 1e-6) greatest = c;
  return greatest < 0 ? -v : v;
}

Frame principal_frame(const LatticeSurface& surface) {
  const Covariance c = surface.covariance();
  const Eigensystem e = eigensystem(c.matrix);
  auto axes = principal_axes(e);
  for (std::size_t i = 0; i < 2; ++i) {
    const double variance = std::max(e.values[i], 1e-300);
    const double skew = surface.skew(c.mean, axes[i], variance);
    if (std::abs(skew) > kNoSkew)
      axes[i] = skew < 0 ? -axes[i] : axes[i];
    else
      axes[i] = with_greatest_component_positive(axes[i]);
  }
  const Vec3 y = axes[0], x = axes[1];
  return {x, y, cross(x, y)};
}

std::uint64_t mix(std::uint64_t h) {
  h ^= h >> 30;
  h *= 0xbf58476d1ce4e5b9u;
  h ^= h >> 27;
  h *= 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

std::uint64_t position_hash(const Vec3& p) {
  std::uint64_t h = 0x9e3779b97f4a7c15u;
  for (const double c : {p.x, p.y, p.z}) h = mix(h ^ std::bit_cast<std::uint64_t>(c + 0.0)) + h;
  return h;
}

/// Whether the surface closes, points welded by position: the exclusive or of one hash per edge
/// vanishes when every edge has an even number of triangles, the signed sum when every edge is run
/// through as often in either direction; for other shapes they do so but once in 2^64.
struct Closure {
  bool closed = false, oriented = false;
};

Closure closure_of(const Shape& shape) {
  std::vector<std::uint64_t> hash(shape.points.size());
  for (std::size_t i = 0; i < hash.size(); ++i) hash[i] = position_hash(shape.points[i]);
  std::uint64_t parity = 0, sum = 0;
  for (const auto& t : shape.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = hash[t[k]], b = hash[t[(k + 1) % 3]];
      if (a == b) continue;
      const std::uint64_t edge = mix(std::min(a, b) + mix(std::max(a, b)));
      parity ^= edge;
      sum += a < b ? edge : -edge;
    }
  return {parity == 0, parity == 0 && sum == 0};
}

}  // namespace

Normalization normalize(const Shape& shape) {
  if (shape.triangles.empty())
    throw Error(ErrorKind::Empty, "the shape has no faces; give a mesh with at least one face");
  const auto used = used_points(shape);
  Normalization n;
  n.prescale = prescale_of(shape, used);
  Box box;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) box.add(shape.points[i] * n.prescale);
  // A box thinner than the rounding of its own coordinates holds no shape.
  const double magnitude = std::max(length(box.low), length(box.high));
  if (!(box.longest() > 1e-12 * magnitude))
    throw Error(ErrorKind::Empty,
                "all points of the shape coincide; give a shape with some extent");

  n.axes = principal_frame(LatticeSurface(shape, used, n.prescale, box));
  Box own;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) own.add(to_frame(n.axes, shape.points[i] * n.prescale - box.center()));
  n.center = box.center() + from_frame(n.axes, own.center());
  double squared_radius = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i])
      squared_radius =
          std::max(squared_radius, squared_length(shape.points[i] * n.prescale - n.center));
  n.radius = std::sqrt(squared_radius);
  return n;
}

NormalizedShape apply(const Normalization& normalization, const Shape& shape) {
  const auto used = used_points(shape);
  NormalizedShape result;
  std::vector<std::uint32_t> renumbered(shape.points.size());
  Box box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    renumbered[i] = static_cast<std::uint32_t>(result.x.size());
    const Vec3 q = normalization.to_normalized(shape.points[i]);
    box.add(q);
    result.x.push_back(static_cast<float>(q.x));
    result.y.push_back(static_cast<float>(q.y));
    result.z.push_back(static_cast<float>(q.z));
  }
  result.triangles.reserve(shape.triangles.size());
  for (const auto& t : shape.triangles)
    result.triangles.push_back({renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]});
  result.low = box.low;
  result.high = box.high;
  const Closure closure = closure_of(shape);
  result.closed = closure.closed;
  result.oriented = closure.oriented;
  return result;
}

}  // namespace marrow
