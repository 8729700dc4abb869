// Symmetric 3x3 matrices: how firmly a point is held along each direction.
#pragma once

#include <marrow/vec.hpp>

namespace marrow {

struct Symmetric3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

constexpr Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
constexpr Symmetric3 operator*(const Symmetric3& a, double s) {
  return {a.xx * s, a.xy * s, a.xz * s, a.yy * s, a.yz * s, a.zz * s};
}
constexpr Vec3 operator*(const Symmetric3& a, const Vec3& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

constexpr Symmetric3 scaled_identity(double s) { return {s, 0, 0, s, 0, s}; }
constexpr Symmetric3 outer_square(const Vec3& v) {
  return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}

/// Of a matrix that is not singular.
constexpr Symmetric3 inverse(const Symmetric3& a) {
  const double xx = a.yy * a.zz - a.yz * a.yz, xy = a.xz * a.yz - a.xy * a.zz,
               xz = a.xy * a.yz - a.xz * a.yy;
  const double determinant = a.xx * xx + a.xy * xy + a.xz * xz;
  return Symmetric3{xx,
                    xy,
                    xz,
                    a.xx * a.zz - a.xz * a.xz,
                    a.xy * a.xz - a.xx * a.yz,
                    a.xx * a.yy - a.xy * a.xy} *
         (1 / determinant);
}

}  // namespace marrow
