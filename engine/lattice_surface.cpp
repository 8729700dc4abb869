#include <algorithm>
#include <bit>
#include <cmath>

#include "lattice_surface_detail.hpp"

namespace marrow {

namespace {

constexpr double kLattice = 1 << 20;  // cells along the longest side

// Triangles are taken in blocks, each axis and corner a row, so that a compiler can work on several
// at once. What a block has no triangle for is zero and weighs nothing.
constexpr std::size_t kBlock = 64;
using Row = std::array<double, kBlock>;

struct Corners {
  Row a{}, b{}, c{};  // along one axis
};

/// From 2^52 to 2^53 the doubles are the integers: adding this rounds to the nearest, half to even,
/// and leaves the integer in the lowest bits. Right for less than 2^51.
constexpr double kRounding = 0x1.8p52;
/// With no greater weights no summand below reaches 2^51.
constexpr double kSmallWeight = 0x1p34;

/// Calls visit(first, count) for every block of `size`.
template <class Visit>
void for_blocks(std::size_t size, Visit visit) {
  for (std::size_t first = 0; first < size; first += kBlock)
    visit(first, std::min(kBlock, size - first));
}

/// Sums of term(k) over a block, each rounded to an integer.
class RoundedSums {
 public:
  explicit RoundedSums(const Row& weights)
      : all_small_(*std::max_element(weights.begin(), weights.end()) <= kSmallWeight) {}

  template <class Term>
  Int128 operator()(Term term) const {
    if (!all_small_) return of_large(term);
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < kBlock; ++k)
      bits += std::bit_cast<std::uint64_t>(term(k) + kRounding);
    return static_cast<std::int64_t>(bits - kBlock * std::bit_cast<std::uint64_t>(kRounding));
  }

 private:
  template <class Term>
  static Int128 of_large(Term term) {
    Int128 sum = 0;
    for (std::size_t k = 0; k < kBlock; ++k) sum += std::llrint(term(k));
    return sum;
  }

  bool all_small_;
};

void weigh_by_area(const std::array<Corners, 3>& p, Row& w) {
  const auto& [x, y, z] = p;
  for (std::size_t k = 0; k < kBlock; ++k) {
    const double ux = x.b[k] - x.a[k], uy = y.b[k] - y.a[k], uz = z.b[k] - z.a[k];
    const double vx = x.c[k] - x.a[k], vy = y.c[k] - y.a[k], vz = z.c[k] - z.a[k];
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    w[k] = std::sqrt(nx * nx + ny * ny + nz * nz);
  }
}

void weigh_by_edges(const std::array<Corners, 3>& p, Row& w) {
  for (std::size_t k = 0; k < kBlock; ++k) {
    double sum = 0;
    for (const Corners& r : p) {
      const double ab = r.a[k] - r.b[k], bc = r.b[k] - r.c[k], ca = r.c[k] - r.a[k];
      sum += ab * ab + bc * bc + ca * ca;
    }
    w[k] = std::sqrt(sum);
  }
}

void weigh_alike(const std::array<Corners, 3>&, Row& w) { w.fill(0x1p20); }

void add_block(Moments& m, const std::array<Corners, 3>& p, const Row& w) {
  const RoundedSums sum(w);
  m.area += sum([&](std::size_t k) { return w[k] * 0x1p10; });
  for (std::size_t i = 0; i < 3; ++i) {
    const Corners& u = p[i];
    m.first[i] += sum([&](std::size_t k) { return w[k] * (u.a[k] + u.b[k] + u.c[k]) * 0x1p-10; });
  }
  constexpr std::array<std::array<std::size_t, 2>, 6> kPairs{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const Corners &u = p[kPairs[i][0]], &v = p[kPairs[i][1]];
    m.second[i] += sum([&](std::size_t k) {
      const double product = u.a[k] * v.a[k] + u.b[k] * v.b[k] + u.c[k] * v.c[k] +
                             (u.a[k] + u.b[k] + u.c[k]) * (v.a[k] + v.b[k] + v.c[k]);
      return w[k] * product * 0x1p-30;
    });
  }
}

/// The third moment of a block along an axis, in units of 2^50.
Int128 third_moment(const Corners& p, const Row& w) {
  return RoundedSums(w)([&](std::size_t k) {
    // In order, so that the order of the corners does not matter.
    const double low = std::min(p.a[k], p.b[k]), high = std::max(p.a[k], p.b[k]);
    const double a = std::min(low, p.c[k]), middle = std::max(low, p.c[k]);
    const double b = std::min(middle, high), c = std::max(middle, high);
    const double cubic = a * a * a + b * b * b + c * c * c + a * a * b + a * a * c + b * b * a +
                         b * b * c + c * c * a + c * c * b + a * b * c;
    return w[k] * cubic * 0x1p-50;
  });
}

}  // namespace

Covariance Moments::covariance() const {
  const double weight = static_cast<double>(area) * 0x1p-10;
  const auto mean_of = [&](std::size_t i) {
    return static_cast<double>(first[i]) * 0x1p10 / (3 * weight);
  };
  const Vec3 mean{mean_of(0), mean_of(1), mean_of(2)};
  const auto mean_product = [&](std::size_t i) {
    return static_cast<double>(second[i]) * 0x1p30 / (12 * weight);
  };
  return {mean,
          {mean_product(0) - mean.x * mean.x, mean_product(1) - mean.y * mean.y,
           mean_product(2) - mean.z * mean.z, mean_product(3) - mean.x * mean.y,
           mean_product(4) - mean.x * mean.z, mean_product(5) - mean.y * mean.z}};
}

LatticeSurface::LatticeSurface(const Shape& shape, double prescale, const Vec3& center,
                               double longest_side)
    : triangles_(shape.triangles), points_(shape.points.size()), weights_(triangles_.size()) {
  const double scale = kLattice / longest_side;
  const auto to_lattice = [](double v) { return static_cast<float>((v + kRounding) - kRounding); };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 q = (shape.points[i] * prescale - center) * scale;
    points_[i] = {to_lattice(q.x), to_lattice(q.y), to_lattice(q.z)};
  }
  weigh_triangles(weigh_by_area);
  if (moments_.area == 0) weigh_triangles(weigh_by_edges);
  if (moments_.area == 0) weigh_triangles(weigh_alike);
}

template <class Weigh>
void LatticeSurface::weigh_triangles(Weigh weigh) {
  moments_ = {};
  std::array<Corners, 3> p;
  for_blocks(triangles_.size(), [&](std::size_t first, std::size_t count) {
    if (count < kBlock) p = {};
    for (std::size_t k = 0; k < count; ++k) {
      const auto [a, b, c] = triangles_[first + k];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis].a[k] = static_cast<double>(points_[a][axis]);
        p[axis].b[k] = static_cast<double>(points_[b][axis]);
        p[axis].c[k] = static_cast<double>(points_[c][axis]);
      }
    }
    Row w;
    weigh(p, w);
    std::fill(w.begin() + static_cast<std::ptrdiff_t>(count), w.end(), 0.0);
    add_block(moments_, p, w);
    std::copy_n(w.begin(), count, weights_.begin() + static_cast<std::ptrdiff_t>(first));
  });
}

std::array<double, 2> LatticeSurface::third_moments(const Vec3& mean,
                                                    const std::array<Vec3, 2>& axes) const {
  std::vector<std::array<double, 2>> along(points_.size());
  for (std::size_t i = 0; i < along.size(); ++i) {
    const auto [x, y, z] = points_[i];
    const Vec3 p = Vec3{double{x}, double{y}, double{z}} - mean;
    along[i] = {dot(p, axes[0]), dot(p, axes[1])};
  }
  std::array<Int128, 2> sums{};
  std::array<Corners, 2> p;
  for_blocks(triangles_.size(), [&](std::size_t first, std::size_t count) {
    Row w{};
    std::copy_n(weights_.begin() + static_cast<std::ptrdiff_t>(first), count, w.begin());
    for (std::size_t k = 0; k < count; ++k) {
      const auto [a, b, c] = triangles_[first + k];
      for (std::size_t axis = 0; axis < 2; ++axis) {
        p[axis].a[k] = along[a][axis];
        p[axis].b[k] = along[b][axis];
        p[axis].c[k] = along[c][axis];
      }
    }
    for (std::size_t axis = 0; axis < 2; ++axis) sums[axis] += third_moment(p[axis], w);
  });
  const auto mean_of = [&](Int128 sum) {
    return static_cast<double>(sum) * 0x1p60 / (10 * static_cast<double>(moments_.area));
  };
  return {mean_of(sums[0]), mean_of(sums[1])};
}

}  // namespace marrow
