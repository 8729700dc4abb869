#include "elastic_line_detail.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace marrow {

namespace {

constexpr double kLeastLength = 1e-5;  // normalised: shorter edges count as long as this
constexpr double kPrecision = 1e-12;   // of the squared residual
constexpr int kMostSteps = 200;

/// The second derivative at a point as a sum over it and its neighbours.
struct Bend {
  std::array<std::size_t, 3> points;
  std::array<double, 3> factors;
  double weight;
};

/// The quadratic form of a line, as a product with a vector of places.
class ElasticForm {
 public:
  ElasticForm(const BranchLine& line, std::span<const Target> targets,
              std::span<const double> stiffness)
      : held_(line.size()), free_(line.size()) {
    std::vector<double> lengths;
    for (std::size_t e = 0; e < line.edge_count(); ++e)
      lengths.push_back(std::max(line.edge_length(e), kLeastLength));
    for (std::size_t i = 0; i < line.size(); ++i) {
      free_[i] = line.is_fixed(i) ? 0 : 1;
      const bool has_before = line.is_ring || i > 0, has_after = line.is_ring || i + 1 < line.size();
      const double before = has_before ? lengths[line.is_ring ? line.before(i) : i - 1] : 0;
      const double after = has_after ? lengths[i] : 0;
      const double share = 0.5 * (before + after);
      held_[i] = targets[i].weight * share;
      if (!has_before || !has_after) continue;
      const double a = 1 / (share * before), b = 1 / (share * after);
      bends_.push_back(
          {{line.before(i), i, line.after(i)}, {a, -a - b, b}, stiffness[i] * share});
    }
  }

  bool is_free(std::size_t i) const { return free_[i] != 0; }
  const Symmetric3& held(std::size_t i) const { return held_[i]; }

  /// The matrix times `x`; zero at fixed points.
  void multiply(std::span<const Vec3> x, std::span<Vec3> result) const {
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = held_[i] * x[i];
    for (const Bend& bend : bends_) {
      Vec3 curvature;
      for (std::size_t k = 0; k < 3; ++k) curvature += x[bend.points[k]] * bend.factors[k];
      for (std::size_t k = 0; k < 3; ++k)
        result[bend.points[k]] += curvature * (bend.weight * bend.factors[k]);
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!is_free(i)) result[i] = {};
  }

  /// Inverses of the blocks on the diagonal.
  std::vector<Symmetric3> block_inverses() const {
    std::vector<Symmetric3> blocks = held_;
    for (const Bend& bend : bends_)
      for (std::size_t k = 0; k < 3; ++k)
        blocks[bend.points[k]] =
            blocks[bend.points[k]] +
            scaled_identity(bend.weight * bend.factors[k] * bend.factors[k]);
    for (Symmetric3& block : blocks) block = inverse(block);
    return blocks;
  }

 private:
  std::vector<Symmetric3> held_;
  std::vector<std::uint8_t> free_;
  std::vector<Bend> bends_;
};

double product(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

}  // namespace

std::vector<Vec3> relax(const BranchLine& line, std::span<const Target> targets,
                        std::span<const double> stiffness) {
  const ElasticForm form(line, targets, stiffness);
  const std::size_t n = line.size();
  std::vector<Vec3> x(n), residual(n), step(n), image(n), eased(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = line.points[i].position;
  // Conjugate gradients from where the line is; the residual is zero at fixed points.
  form.multiply(x, image);
  for (std::size_t i = 0; i < n; ++i)
    if (form.is_free(i)) residual[i] = form.held(i) * targets[i].place - image[i];
  const std::vector<Symmetric3> blocks = form.block_inverses();
  const auto ease = [&] {
    for (std::size_t i = 0; i < n; ++i) eased[i] = blocks[i] * residual[i];
  };
  ease();
  step = eased;
  double descent = product(residual, eased);
  const double enough = kPrecision * descent;
  for (int k = 0; k < kMostSteps && descent > enough; ++k) {
    form.multiply(step, image);
    const double along = descent / product(step, image);
    for (std::size_t i = 0; i < n; ++i) x[i] += step[i] * along, residual[i] += image[i] * -along;
    ease();
    const double next = product(residual, eased);
    for (std::size_t i = 0; i < n; ++i) step[i] = eased[i] + step[i] * (next / descent);
    descent = next;
  }
  return x;
}

}  // namespace marrow
