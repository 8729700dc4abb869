#include <algorithm>
#include <array>
#include <map>

#include "band_matrix_detail.hpp"
#include "elastic_line_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastLength = 1e-5;  // normalised: shorter edges count as this long
constexpr double kPrecision = 1e-18;   // of the squared residual
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

  std::span<const Symmetric3> held() const { return held_; }
  std::span<const Bend> bends() const { return bends_; }

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

/// The points of each line between its joints, as if all others stood still, and the joints each
/// on its own: nearly the inverse of the form, as lines touch in joints only.
class LineInverse {
 public:
  LineInverse(std::span<const BranchLine> lines, const ElasticForm& form, const Numbering& number)
      : place_(number.count()) {
    for (std::size_t l = 0; l < lines.size(); ++l) {
      std::vector<std::size_t> points;
      for (std::size_t i = 0; i < lines[l].size(); ++i)
        if (!lines[l].is_joint(i)) points.push_back(number(l, i));
      add(std::move(points));
    }
    for (std::size_t n = 0; n < place_.size(); ++n)
      if (place_[n].part == kNone) add({n});
    fill(form);
  }

  void apply(std::span<const Vec3> x, std::span<Vec3> result) const {
    std::vector<Vec3> values;
    for (const Part& part : parts_) {
      values.clear();
      for (const std::size_t n : part.points) values.push_back(x[n]);
      part.matrix.solve(values);
      for (std::size_t i = 0; i < values.size(); ++i) result[part.points[i]] = values[i];
    }
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  struct Part {
    std::vector<std::size_t> points;
    BandMatrix matrix;
  };
  struct Place {
    std::size_t part = kNone, index = 0;
  };

  void add(std::vector<std::size_t> points) {
    for (std::size_t i = 0; i < points.size(); ++i) place_[points[i]] = {parts_.size(), i};
    BandMatrix matrix(points.size());
    parts_.push_back({std::move(points), std::move(matrix)});
  }

  void fill(const ElasticForm& form) {
    for (std::size_t n = 0; n < place_.size(); ++n)
      parts_[place_[n].part].matrix.add(place_[n].index, form.held()[n]);
    for (const Bend& bend : form.bends()) {
      const bool closes_ring = is_far(bend, 0, 1) || is_far(bend, 1, 2) || is_far(bend, 0, 2);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = closes_ring ? a : 0; b <= a; ++b) add(bend, a, b);
    }
    for (Part& part : parts_) part.matrix.factorise();
  }

  /// Whether two points of a bend are of one part but not near in it, as where a ring closes.
  bool is_far(const Bend& bend, std::size_t a, std::size_t b) const {
    const Place &p = place_[bend.points[a]], &q = place_[bend.points[b]];
    return p.part == q.part && std::max(p.index, q.index) - std::min(p.index, q.index) > 2;
  }

  void add(const Bend& bend, std::size_t a, std::size_t b) {
    const Place &p = place_[bend.points[a]], &q = place_[bend.points[b]];
    if (p.part == q.part)
      parts_[p.part].matrix.add(p.index, q.index, bend.weight * bend.factors[a] * bend.factors[b]);
  }

  std::vector<Place> place_;
  std::vector<Part> parts_;
};

double product(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

/// Conjugate gradients from `x` on.
void solve(const ElasticForm& form, const LineInverse& nearly_inverse, std::vector<Vec3>& x) {
  const std::size_t n = x.size();
  std::vector<Vec3> residual(n), image(n), eased(n);
  form.multiply(x, image);
  for (std::size_t i = 0; i < n; ++i) residual[i] = form.drawn()[i] - image[i];
  nearly_inverse.apply(residual, eased);
  std::vector<Vec3> step = eased;
  double descent = product(residual, eased);
  const double enough = kPrecision * descent;
  for (int k = 0; k < kMostSteps && descent > enough; ++k) {
    form.multiply(step, image);
    const double along = descent / product(step, image);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step[i] * along;
      residual[i] += image[i] * -along;
    }
    nearly_inverse.apply(residual, eased);
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
  const ElasticForm form(lines, holds, number);
  solve(form, LineInverse(lines, form, number), x);
  std::vector<std::vector<Vec3>> places(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t i = 0; i < lines[l].size(); ++i) places[l].push_back(x[number(l, i)]);
  return places;
}

}  // namespace marrow
