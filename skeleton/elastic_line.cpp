#include <algorithm>
#include <array>
#include <map>

#include "elastic_line_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastLength = 1e-5;  // normalised: shorter edges count as this long
constexpr double kPrecision = 1e-9;    // of the squared residual
constexpr int kMostSteps = 200;

/// Numbers the points of all lines; one number for a joint.
class Numbering {
 public:
  explicit Numbering(std::span<const BranchLine> lines) {
    std::map<NodeId, std::size_t> joints;
    for (const BranchLine& line : lines) {
      auto& numbers = numbers_.emplace_back();
      for (std::size_t i = 0; i < line.size(); ++i) {
        std::size_t number = count_;
        if (line.is_joint(i))
          number = joints.try_emplace(i == 0 ? line.start : line.end, count_).first->second;
        numbers.push_back(number);
        if (number == count_) ++count_;
      }
    }
  }

  std::size_t count() const { return count_; }
  std::size_t operator()(std::size_t line, std::size_t point) const {
    return numbers_[line][point];
  }

 private:
  std::vector<std::vector<std::size_t>> numbers_;
  std::size_t count_ = 0;
};

/// The second derivative at a point as a sum over it and its neighbours.
struct Bend {
  std::array<std::size_t, 3> points;
  std::array<double, 3> factors;
  double weight;
};

/// The quadratic form of the lines, as a product with a vector of places.
class ElasticForm {
 public:
  ElasticForm(std::span<const BranchLine> lines, const Holds& holds, const Numbering& number)
      : held_(number.count()), drawn_(number.count()) {
    for (std::size_t l = 0; l < lines.size(); ++l) add(lines[l], holds[l], l, number);
  }

  /// What draws the points, as the right side of the equation.
  std::span<const Vec3> drawn() const { return drawn_; }

  void multiply(std::span<const Vec3> x, std::span<Vec3> result) const {
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = held_[i] * x[i];
    for (const Bend& bend : bends_) {
      Vec3 curvature;
      for (std::size_t k = 0; k < 3; ++k) curvature += x[bend.points[k]] * bend.factors[k];
      for (std::size_t k = 0; k < 3; ++k)
        result[bend.points[k]] += curvature * (bend.weight * bend.factors[k]);
    }
  }

  /// Inverses of the blocks on the diagonal.
  std::vector<Symmetric3> block_inverses() const {
    std::vector<Symmetric3> blocks = held_;
    for (const Bend& bend : bends_)
      for (std::size_t k = 0; k < 3; ++k)
        blocks[bend.points[k]] = blocks[bend.points[k]] +
                                 scaled_identity(bend.weight * bend.factors[k] * bend.factors[k]);
    for (Symmetric3& block : blocks) block = inverse(block);
    return blocks;
  }

 private:
  void add(const BranchLine& line, const std::vector<Hold>& holds, std::size_t l,
           const Numbering& number) {
    std::vector<double> lengths;
    for (std::size_t e = 0; e < line.edge_count(); ++e)
      lengths.push_back(std::max(line.edge_length(e), kLeastLength));
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool is_first = !line.is_ring && i == 0,
                 is_last = !line.is_ring && i + 1 == line.size();
      const double before = is_first ? 0 : lengths[line.before(i)];
      const double after = is_last ? 0 : lengths[i];
      const double share = 0.5 * (before + after);
      const Symmetric3 weight = holds[i].weight * share;
      held_[number(l, i)] = held_[number(l, i)] + weight;
      drawn_[number(l, i)] += weight * holds[i].place;
      if (is_first || is_last) continue;
      const double a = 1 / (share * before), b = 1 / (share * after);
      bends_.push_back({{number(l, line.before(i)), number(l, i), number(l, line.after(i))},
                        {a, -a - b, b},
                        holds[i].stiffness * share});
    }
  }

  std::vector<Symmetric3> held_;
  std::vector<Vec3> drawn_;
  std::vector<Bend> bends_;
};

double product(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

/// Conjugate gradients from `x` on.
void solve(const ElasticForm& form, std::vector<Vec3>& x) {
  const std::size_t n = x.size();
  const std::vector<Symmetric3> blocks = form.block_inverses();
  std::vector<Vec3> residual(n), image(n), eased(n);
  form.multiply(x, image);
  for (std::size_t i = 0; i < n; ++i) residual[i] = form.drawn()[i] - image[i];
  for (std::size_t i = 0; i < n; ++i) eased[i] = blocks[i] * residual[i];
  std::vector<Vec3> step = eased;
  double descent = product(residual, eased);
  const double enough = kPrecision * descent;
  for (int k = 0; k < kMostSteps && descent > enough; ++k) {
    form.multiply(step, image);
    const double along = descent / product(step, image);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step[i] * along;
      residual[i] += image[i] * -along;
      eased[i] = blocks[i] * residual[i];
    }
    const double next = product(residual, eased);
    for (std::size_t i = 0; i < n; ++i) step[i] = eased[i] + step[i] * (next / descent);
    descent = next;
  }
}

}  // namespace

std::vector<std::vector<Vec3>> relax(std::span<const BranchLine> lines, const Holds& holds) {
  const Numbering number(lines);
  std::vector<Vec3> x(number.count());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t i = 0; i < lines[l].size(); ++i) x[number(l, i)] = lines[l].points[i].position;
  solve(ElasticForm(lines, holds, number), x);
  std::vector<std::vector<Vec3>> places(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t i = 0; i < lines[l].size(); ++i) places[l].push_back(x[number(l, i)]);
  return places;
}

}  // namespace marrow
