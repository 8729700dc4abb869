// Equations of points along a line, each with its two neighbours on either side.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "symmetric3_detail.hpp"

namespace marrow {

/// A symmetric, positive definite matrix of 3 x 3 blocks, two beside the diagonal; solved directly.
class BandMatrix {
 public:
  explicit BandMatrix(std::size_t points) : rows_(3 * points) {}

  std::size_t size() const { return rows_.size() / 3; }
  void add(std::size_t point, const Symmetric3& block);
  /// Adds `value` on the diagonal of the block of two points at most two apart.
  void add(std::size_t a, std::size_t b, double value);

  /// Makes the matrix ready for solve(); nothing may be added after.
  void factorise();
  /// Turns the right side of an equation into its solution.
  void solve(std::span<Vec3> x) const;

 private:
  static constexpr std::size_t kWidth = 9;  // a row from eight columns before the diagonal up to it

  double& at(std::size_t row, std::size_t column) { return rows_[row][column + kWidth - 1 - row]; }

  std::vector<std::array<double, kWidth>> rows_;  ///< then L below, 1 / D on the diagonal
};

}  // namespace marrow
