#include <band_matrix_detail.hpp>

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "random.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

/// A + s 1 between points, by blocks: what the matrix under test stands for.
struct Blocks {
  std::vector<Symmetric3> diagonal;
  std::vector<double> next, after_next;  ///< of point i and i + 1, i + 2

  Vec3 times(const std::vector<Vec3>& x, std::size_t i) const {
    Vec3 sum = diagonal[i] * x[i];
    if (i + 1 < x.size()) sum += x[i + 1] * next[i];
    if (i + 2 < x.size()) sum += x[i + 2] * after_next[i];
    if (i >= 1) sum += x[i - 1] * next[i - 1];
    if (i >= 2) sum += x[i - 2] * after_next[i - 2];
    return sum;
  }
};

/// Diagonally dominant, so positive definite.
Blocks random_blocks(std::size_t points, Random& random) {
  Blocks blocks;
  for (std::size_t i = 0; i < points; ++i) {
    blocks.diagonal.push_back(scaled_identity(5) + outer_square(random.vector()));
    blocks.next.push_back(random.vector().x);
    blocks.after_next.push_back(random.vector().x);
  }
  return blocks;
}

}  // namespace

TEST_CASE("a band of blocks is solved as it was set up", "[refinement]") {
  Random random(5);
  for (const std::size_t points : {1, 2, 3, 4, 17, 60}) {
    INFO(points);
    const Blocks blocks = random_blocks(points, random);
    BandMatrix matrix(points);
    CHECK(matrix.size() == points);
    std::vector<Vec3> right;
    for (std::size_t i = 0; i < points; ++i) {
      matrix.add(i, blocks.diagonal[i]);
      if (i + 1 < points) matrix.add(i, i + 1, blocks.next[i]);
      if (i + 2 < points) matrix.add(i + 2, i, blocks.after_next[i]);
      right.push_back(random.vector());
    }
    matrix.factorise();
    std::vector<Vec3> x = right;
    matrix.solve(x);
    for (std::size_t i = 0; i < points; ++i) CHECK(length(blocks.times(x, i) - right[i]) < 1e-12);
  }
}
