// Centre lines: chains of balls.
#pragma once

#include <marrow/vec.hpp>

#include <vector>

namespace marrow {

struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// A chain of balls; a closed one does not repeat its first ball.
struct Curve {
  std::vector<Ball> balls;
  bool is_closed = false;
};

/// `count` balls of `ball_at(t)` for t in [0, 1] (open, both ends included) or [0, 1) (closed).
template <class BallAt>
Curve sample_curve(int count, bool is_closed, const BallAt& ball_at) {
  Curve curve;
  curve.is_closed = is_closed;
  curve.balls.reserve(static_cast<std::size_t>(count));
  const int spans = is_closed ? count : count - 1;
  for (int i = 0; i < count; ++i) curve.balls.push_back(ball_at(static_cast<double>(i) / spans));
  return curve;
}

/// A smooth open chain through the balls `through` (centripetal Catmull-Rom, which makes no loops
/// and no overshoots), with `spans` pieces between two of them. Needs at least two distinct balls.
std::vector<Ball> spline(const std::vector<Ball>& through, int spans);

/// The same chain of straight pieces, each cut into equal parts no longer than `step`.
std::vector<Ball> subdivided(const std::vector<Ball>& chain, double step);

/// Length along the chain.
double length_of(const std::vector<Ball>& chain);

}  // namespace marrow
