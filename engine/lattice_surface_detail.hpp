// A surface on an integer lattice: moments that no order of triangles and corners can change.
#pragma once

#include <marrow/shape.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "eigen_detail.hpp"

namespace marrow {

__extension__ using Int128 = __int128;

/// Mean and second central moments, lattice units.
struct Covariance {
  Vec3 mean;
  SymmetricMatrix matrix;
};

/// Weighted sums over a surface of 1, x and x xᵀ, each in a unit of its own.
struct Moments {
  Int128 area = 0;
  std::array<Int128, 3> first{};
  std::array<Int128, 6> second{};  // xx, yy, zz, xy, xz, yz

  Covariance covariance() const;
};

class LatticeSurface {
 public:
  /// Points are taken times `prescale`; the box of those that are used has this centre and longest
  /// side. `shape` must outlive this.
  LatticeSurface(const Shape& shape, double prescale, const Vec3& center, double longest_side);

  /// Weighted by area; where all triangles are needles, by the lengths of their edges; where the
  /// corners of all of them coincide, each one the same.
  const Moments& moments() const { return moments_; }

  /// The third central moment along each of two axes, by the same weights.
  std::array<double, 2> third_moments(const Vec3& mean, const std::array<Vec3, 2>& axes) const;

 private:
  using Point = std::array<float, 3>;  // integers up to 2^19, which a float holds

  template <class Weigh>
  void weigh_triangles(Weigh weigh);

  std::span<const Triangle> triangles_;
  std::vector<Point> points_;
  std::vector<double> weights_;  // of the triangles
  Moments moments_;
};

}  // namespace marrow
