#include "curve.hpp"

#include <algorithm>
#include <cmath>

namespace marrow {
namespace {

Ball mix(const Ball& a, const Ball& b, double t) {
  return {a.centre + (b.centre - a.centre) * t, a.radius + (b.radius - a.radius) * t};
}

/// Barry and Goldman's pyramid for the span between `b` and `c`.
Ball catmull_rom(const Ball& a, const Ball& b, const Ball& c, const Ball& d, double t) {
  const auto knot = [](const Ball& p, const Ball& q) {
    return std::max(std::sqrt(distance(p.centre, q.centre)), 1e-9);
  };
  const double ta = -knot(a, b);
  const double tc = knot(b, c);
  const double td = tc + knot(c, d);
  const double s = t * tc;
  const Ball ab = mix(a, b, (s - ta) / -ta);
  const Ball bc = mix(b, c, s / tc);
  const Ball cd = mix(c, d, (s - tc) / (td - tc));
  const Ball abc = mix(ab, bc, (s - ta) / (tc - ta));
  const Ball bcd = mix(bc, cd, s / td);
  return mix(abc, bcd, t);
}

}  // namespace

std::vector<Ball> spline(const std::vector<Ball>& through, int spans) {
  std::vector<Ball> chain;
  const std::size_t last = through.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Ball& b = through[i];
    const Ball& c = through[i + 1];
    const Ball before = i > 0 ? through[i - 1] : mix(c, b, 2);
    const Ball after = i + 1 < last ? through[i + 2] : mix(b, c, 2);
    for (int j = 0; j < spans; ++j) {
      Ball ball = catmull_rom(before, b, c, after, static_cast<double>(j) / spans);
      ball.radius = std::clamp(ball.radius, std::min(b.radius, c.radius) * 0.9,
                               std::max(b.radius, c.radius) * 1.1);
      chain.push_back(ball);
    }
  }
  chain.push_back(through.back());
  return chain;
}

std::vector<Ball> subdivided(const std::vector<Ball>& chain, double step) {
  std::vector<Ball> out;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const double span = distance(chain[i].centre, chain[i + 1].centre);
    const int parts = std::max(1, static_cast<int>(std::ceil(span / step)));
    for (int j = 0; j < parts; ++j) {
      out.push_back(mix(chain[i], chain[i + 1], static_cast<double>(j) / parts));
    }
  }
  out.push_back(chain.back());
  return out;
}

double length_of(const std::vector<Ball>& chain) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    sum += distance(chain[i].centre, chain[i + 1].centre);
  }
  return sum;
}

}  // namespace marrow
