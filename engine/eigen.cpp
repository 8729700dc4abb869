#include <algorithm>
#include <cmath>
#include <numeric>

#include "eigen_detail.hpp"

namespace marrow {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// One rotation in the plane of axes p and q that clears a[p][q]; `v` gathers the rotations.
void rotate(Matrix& a, Matrix& v, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = v[k][p], kq = v[k][q];
    v[k][p] = c * kp - s * kq;
    v[k][q] = s * kp + c * kq;
  }
}

}  // namespace

Eigensystem eigensystem(const SymmetricMatrix& m) {
  // Scaled to one, so that squares neither overflow nor vanish.
  const double scale = std::max({std::abs(m.xx), std::abs(m.yy), std::abs(m.zz), std::abs(m.xy),
                                 std::abs(m.xz), std::abs(m.yz)});
  Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Eigensystem result;
  if (scale == 0) {
    result.vectors = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    return result;
  }
  Matrix a{{{m.xx / scale, m.xy / scale, m.xz / scale},
            {m.xy / scale, m.yy / scale, m.yz / scale},
            {m.xz / scale, m.yz / scale, m.zz / scale}}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    const double off = std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
    if (off < 1e-18) break;
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = order[i];
    result.values[i] = a[k][k] * scale;
    result.vectors[i] = normalized({v[0][k], v[1][k], v[2][k]});
  }
  return result;
}

}  // namespace marrow
