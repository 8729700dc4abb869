#include <marrow/view.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "centredness_detail.hpp"
#include "enclosure_detail.hpp"
#include "percentile_detail.hpp"

namespace marrow {

namespace {

constexpr double kLongest = 8;         // of a ray, and of a distance: more than any in the frame
constexpr double kHalfChord = 0.5;     // of the ball's radius
constexpr double kLeastChord = 0.004;  // of the diagonal
constexpr std::size_t kPairs = 32, kLeastPairs = 16;

using Direction = std::array<double, 2>;

/// Half a turn in equal steps, by halving angles; the first is not along an axis.
std::array<Direction, kPairs> half_turn() {
  const auto middle = [](const Direction& a, const Direction& b) {
    const double x = a[0] + b[0], y = a[1] + b[1], length = std::sqrt(x * x + y * y);
    return Direction{x / length, y / length};
  };
  constexpr std::size_t kSteps = 4 * kPairs;  // of half a turn; every fourth is taken
  std::array<Direction, kSteps + 1> steps{};
  steps[0] = {1, 0}, steps[kSteps / 2] = {0, 1}, steps[kSteps] = {-1, 0};
  for (std::size_t width = kSteps / 2; width > 1; width /= 2)
    for (std::size_t at = 0; at < kSteps; at += width)
      steps[at + width / 2] = middle(steps[at], steps[at + width]);
  std::array<Direction, kPairs> result{};
  for (std::size_t i = 0; i < kPairs; ++i) result[i] = steps[4 * i + 1];
  return result;
}

/// A branch as a curve of its length.
class Line {
 public:
  Line(const CurveSkeleton& skeleton, const Branch& branch) : is_closed_(branch.is_closed()) {
    for (const NodeId n : branch.nodes) {
      const Vec3& p = skeleton.nodes[n].position;
      way_.push_back(way_.empty() ? 0 : way_.back() + distance(points_.back(), p));
      points_.push_back(p);
    }
  }

  double length() const { return way_.back(); }
  bool is_closed() const { return is_closed_; }
  double to_end(double way) const { return is_closed_ ? kLongest : std::min(way, length() - way); }

  Vec3 at(double way) const {
    if (is_closed_) way -= length() * std::floor(way / length());
    way = std::clamp(way, 0.0, length());
    const auto after = std::upper_bound(way_.begin() + 1, way_.end() - 1, way);
    const auto i = static_cast<std::size_t>(after - way_.begin());
    const double step = way_[i] - way_[i - 1];
    const double t = step > 0 ? (way - way_[i - 1]) / step : 0;
    return points_[i - 1] * (1 - t) + points_[i] * t;
  }

  Vec3 chord(double way, double half) const {
    if (!is_closed_) half = std::min(half, 0.5 * length());
    return at(way + half) - at(way - half);
  }

 private:
  bool is_closed_;
  std::vector<double> way_;
  std::vector<Vec3> points_;
};

/// The mean over the pairs whose both rays meet the surface; nothing if there are too few.
std::optional<double> off_centre(const SurfaceScene& surface, const Vec3& p, const Vec3& along) {
  static const auto directions = half_turn();
  const Frame section = frame_along(along);
  double sum = 0;
  std::size_t pairs = 0;
  for (const Direction& d : directions) {
    const Vec3 way = section.x * d[0] + section.y * d[1];
    const auto a = surface.first_hit(p, way, kLongest), b = surface.first_hit(p, -way, kLongest);
    if (!a || !b) continue;
    const double across = a->distance + b->distance;
    sum += across > 0 ? std::abs(a->distance - b->distance) / across : 0;
    ++pairs;
  }
  if (pairs < kLeastPairs) return {};
  return sum / static_cast<double>(pairs);
}

/// Off-centre values of one branch, a step apart.
void measure(const SurfaceScene& surface, const Line& line, double step, double diagonal,
             std::vector<double>& values) {
  double reach = kLongest;
  for (double way = 0.5 * step; way < line.length(); way += step) {
    const Vec3 p = line.at(way);
    const auto nearest = surface.nearest(p, reach);
    const double radius = nearest ? nearest->distance : reach;
    reach = radius + 1.001 * step;
    if (line.to_end(way) < radius || !encloses(surface, p)) continue;
    const Vec3 chord = line.chord(way, std::max(kHalfChord * radius, kLeastChord * diagonal));
    if (squared_length(chord) == 0) continue;
    if (const auto value = off_centre(surface, p, chord)) values.push_back(*value);
  }
}

}  // namespace

std::optional<Centredness> centredness(const SurfaceScene& surface, const CurveSkeleton& skeleton,
                                       double diagonal, int samples) {
  const double step = total_length(skeleton) / samples;
  if (!(step > 0)) return {};
  std::vector<double> values;
  for (const Branch& branch : branches(skeleton))
    measure(surface, Line(skeleton, branch), step, diagonal, values);
  if (values.empty()) return {};
  return Centredness{mean_of(values), percentile(values, 0.9), values.size()};
}

}  // namespace marrow
