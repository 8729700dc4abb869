// Eigenvectors of a symmetric 3x3 matrix by Jacobi rotations: square roots only, so that the bits
// are the same everywhere.
#pragma once

#include <marrow/vec.hpp>

#include <array>

namespace marrow {

struct SymmetricMatrix {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

struct Eigensystem {
  std::array<double, 3> values{};  // greatest first
  std::array<Vec3, 3> vectors{};   // orthonormal
};

Eigensystem eigensystem(const SymmetricMatrix& m);

}  // namespace marrow
