#include <algorithm>
#include <vector>

#include "band_matrix_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastPivot = 1e-12;

}  // namespace

void BandMatrix::add(std::size_t point, const Symmetric3& block) {
  const std::size_t r = 3 * point;
  at(r, r) += block.xx;
  at(r + 1, r) += block.xy;
  at(r + 1, r + 1) += block.yy;
  at(r + 2, r) += block.xz;
  at(r + 2, r + 1) += block.yz;
  at(r + 2, r + 2) += block.zz;
}

void BandMatrix::add(std::size_t a, std::size_t b, double value) {
  const auto [low, high] = std::minmax(a, b);
  for (std::size_t axis = 0; axis < 3; ++axis) at(3 * high + axis, 3 * low + axis) += value;
}

void BandMatrix::factorise() {
  constexpr std::size_t kLast = kWidth - 1;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    auto& row = rows_[i];
    const std::size_t first = i < kLast ? kLast - i : 0;
    const double diagonal = row[kLast];
    double pivot = diagonal;
    for (std::size_t k = first; k < kLast; ++k) {
      const auto& above = rows_[i + k - kLast];
      double value = row[k];  // L times D, so far
      for (std::size_t m = first; m < k; ++m) value -= row[m] * above[m + kLast - k];
      row[k] = value;
    }
    for (std::size_t k = first; k < kLast; ++k) {
      const double scaled = row[k] * rows_[i + k - kLast][kLast];
      pivot -= row[k] * scaled;
      row[k] = scaled;
    }
    row[kLast] = 1 / std::max(pivot, kLeastPivot * diagonal);  // what rounding leaves of it
  }
}

void BandMatrix::solve(std::span<Vec3> x) const {
  constexpr std::size_t kLast = kWidth - 1;
  std::vector<double> values(kLast, 0.0);  // zeros before the first
  for (const Vec3& v : x) values.insert(values.end(), {v.x, v.y, v.z});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    double value = values[i + kLast];
    for (std::size_t k = 0; k < kLast; ++k) value -= rows_[i][k] * values[i + k];
    values[i + kLast] = value;
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) values[i + kLast] *= rows_[i][kLast];
  for (std::size_t i = rows_.size(); i-- > 0;)
    for (std::size_t k = 0; k < kLast; ++k) values[i + k] -= rows_[i][k] * values[i + kLast];
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double* v = &values[3 * i + kLast];
    x[i] = {v[0], v[1], v[2]};
  }
}

}  // namespace marrow
