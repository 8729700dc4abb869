// Tubes along curves: the centre line is the curve itself.
#include <algorithm>

#include "models.hpp"
#include "trig.hpp"
#include "tube.hpp"

namespace marrow {
namespace {

constexpr int kTruthSamples = 240;

void append_truth(CurveSkeleton& truth, const Curve& curve) {
  const auto first = static_cast<NodeId>(truth.nodes.size());
  const auto count = static_cast<NodeId>(curve.balls.size());
  for (const Ball& ball : curve.balls) truth.nodes.push_back({ball.centre, ball.radius});
  for (NodeId i = 0; i + 1 < count; ++i) truth.edges.push_back({first + i, first + i + 1});
  if (curve.is_closed) truth.edges.push_back({first, first + count - 1});
  std::sort(truth.edges.begin(), truth.edges.end());
}

struct TubeSize {
  int samples;  ///< along the curve
  int sides;    ///< around it
};

template <class BallAt>
void append_tube(Model& model, bool is_closed, const TubeSize& size, const Detail& detail,
                 const BallAt& ball_at) {
  const Curve fine = sample_curve(detail.count(size.samples), is_closed, ball_at);
  append(model.shape, make_tube(fine, std::max(6, detail.count(size.sides))));
  append_truth(model.truth, sample_curve(kTruthSamples, is_closed, ball_at));
}

template <class BallAt>
Model tube_model(bool is_closed, const TubeSize& size, const Detail& detail,
                 const BallAt& ball_at) {
  Model model;
  append_tube(model, is_closed, size, detail, ball_at);
  return model;
}

}  // namespace

Model make_capsule(const Detail& detail) {
  return tube_model(false, {60, 40}, detail, [](double t) {
    return Ball{{3 * t - 1.5, 0, 0}, 0.35};
  });
}

Model make_tapered_capsule(const Detail& detail) {
  return tube_model(false, {60, 40}, detail, [](double t) {
    return Ball{{0, 3.6 * t - 1.8, 0}, 0.5 - 0.36 * t};
  });
}

Model make_beads(const Detail& detail) {
  return tube_model(false, {220, 40}, detail, [](double t) {
    return Ball{{6 * t, 0, 0}, 0.26 - 0.11 * sin_cos_of_turns(6 * t).cos};
  });
}

Model make_s_tube(const Detail& detail) {
  return tube_model(false, {160, 32}, detail, [](double t) {
    const double swell = sin_cos_of_turns(2 * t).sin;
    return Ball{{0.8 * sin_cos_of_turns(t).sin, 3.4 * t - 1.7, 0}, 0.16 + 0.1 * swell * swell};
  });
}

Model make_helix(const Detail& detail) {
  return tube_model(false, {260, 28}, detail, [](double t) {
    const SinCos at = sin_cos_of_turns(3.25 * t);
    return Ball{{at.cos, 3.2 * t - 1.6, at.sin}, 0.17};
  });
}

Model make_snake(const Detail& detail) {
  // A flat spiral from the tip of the tail outward; the neck rises from the last turn.
  return tube_model(false, {620, 24}, detail, [](double t) {
    const SinCos at = sin_cos_of_turns(2.7 * std::sqrt(t * (t + 0.05)));
    const double reach = 0.45 + 2.2 * t;
    const double rise = std::max(0.0, (t - 0.88) / 0.12);
    const double head = std::max(0.0, (t - 0.95) / 0.05);
    const double thickness = 0.03 + 0.1 * std::min(1.0, 2.2 * t) * (1 - 0.35 * rise * rise);
    const double swell = head * head * (1.8 - head) * 0.14;
    return Ball{{reach * at.cos, rise * rise * 0.7, reach * at.sin}, thickness + swell};
  });
}

Model make_torus(const Detail& detail) {
  return tube_model(true, {144, 44}, detail, [](double t) {
    const SinCos at = sin_cos_of_turns(t);
    return Ball{{1.2 * at.cos, 1.2 * at.sin, 0}, 0.35};
  });
}

Model make_trefoil(const Detail& detail) {
  return tube_model(true, {320, 28}, detail, [](double t) {
    const SinCos once = sin_cos_of_turns(t);
    const SinCos twice = sin_cos_of_turns(2 * t);
    const SinCos thrice = sin_cos_of_turns(3 * t);
    return Ball{
        {0.5 * (once.sin + 2 * twice.sin), 0.5 * (once.cos - 2 * twice.cos), -0.6 * thrice.sin},
        0.18};
  });
}

Model make_rings(const Detail& detail) {
  Model model;
  for (int i = 0; i < 3; ++i) {
    append_tube(model, true, {120, 20}, detail, [i](double t) {
      const SinCos at = sin_cos_of_turns(t);
      const double x = 1.45 * (i - 1) + at.cos;
      return i == 1 ? Ball{{x, 0, at.sin}, 0.1} : Ball{{x, at.sin, 0}, 0.1};
    });
  }
  return model;
}

}  // namespace marrow
