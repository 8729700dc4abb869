#include <marrow/view.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "surface_probe_detail.hpp"

namespace marrow {

namespace {

constexpr double kBehind = 1e-5;     // of the diagonal: off a wall, so that a ray leaves it
constexpr double kLeastClip = 1e-4;  // of the diagonal, in place of a smaller radius
constexpr double kClip = 4;          // radii: walls farther off are not told apart
constexpr double kSoft = 0.05;       // keeps a target near where nothing is told
constexpr double kAlong = 0.1;       // weight of a point along the line
constexpr double kLeast = 1e-3;      // weight in every direction
constexpr double kUntold = 0.02;     // weight where too few walls are seen
constexpr double kThinWall = 0.06;   // of the diagonal: two walls with a limb between them
constexpr double kBack = -0.3;       // cosine to where a limb points of ways back into it
constexpr double kSameWay = 0.8;     // cosine between two ways that are one
constexpr double kAside = 0.1;       // of the way to a wall: so far it is taken to go on
constexpr double kSteep = 0.5;       // cosine between a ray and the normal of such a wall
constexpr double kRounding = 1e-9;   // of sums of distances, relative
constexpr double kRootHalf = 0.70710678118654752;

/// An icosahedron's six axes, turned so that none runs along a face of a box.
constexpr std::array<Vec3, 6> kAxes{{{-0.741, -0.046, 0.670},
                                     {0.242, 0.910, -0.337},
                                     {-0.054, 0.750, 0.659},
                                     {0.753, -0.647, 0.120},
                                     {0.261, -0.213, 0.942},
                                     {-0.869, -0.378, -0.319}}};

Vec3 axis(std::size_t i) { return normalized(i < 6 ? kAxes[i] : -kAxes[i - 6]); }

/// Two unit vectors across `t`.
std::array<Vec3, 2> across(const Vec3& t) {
  const double x = std::abs(t.x), y = std::abs(t.y), z = std::abs(t.z);
  const Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 u = normalized(cross(t, least));
  return {u, cross(t, u)};
}

double median(std::span<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// How often the surface goes around each stretch of a ray, the first one first.
std::vector<int> windings(const SurfaceScene& surface, std::span<const SurfaceHit> hits,
                          const Vec3& direction) {
  std::vector<int> around(hits.size() + 1, 0);
  for (std::size_t i = hits.size(); i-- > 0;)
    around[i] = around[i + 1] + (dot(surface.normal(hits[i].triangle), direction) > 0 ? 1 : -1);
  return around;
}

/// Whether parts of the surface lie inside others: rays from the samples run through places that it
/// goes around more than once.
bool runs_through_itself(const SurfaceScene& surface, std::span<const Vec3> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3 direction = axis(i % 12);
    const auto hits = surface.all_hits(samples[i], direction, SurfaceProbe::kFar);
    const auto around = windings(surface, hits, direction);
    for (std::size_t k = 0; k < around.size(); ++k) {
      const bool is_wide =
          k == 0 || k == hits.size() || hits[k].distance - hits[k - 1].distance > 1e-3;
      if (std::abs(around[k]) > 1 && is_wide) return true;
    }
  }
  return false;
}

}  // namespace

Way longest(std::span<const Way> ways, const Vec3& apart_from) {
  Way longest;
  for (const Way& way : ways)
    if (dot(way.direction, apart_from) <= kSameWay && way.length > longest.length) longest = way;
  return longest;
}

SurfaceProbe::SurfaceProbe(const RefinementInput& input, std::span<const Vec3> samples)
    : input_(input),
      diagonal_(distance(input.shape.low, input.shape.high)),
      has_inner_walls_(input.shape.oriented && runs_through_itself(input.surface, samples)) {}

double SurfaceProbe::hull(const Vec3& p) const {
  return std::max(hull_radius(p, input_.projections), 0.5 * input_.pixel);
}

/// Whether the shape goes on behind a wall.
bool SurfaceProbe::is_inner(const Vec3& from, const SurfaceHit& hit) const {
  const Vec3 way = hit.position - from;
  const double long_way = length(way);
  const Vec3 through = long_way > 0 ? way / long_way : axis(0);
  const Vec3 behind = hit.position + through * (kBehind * diagonal_);
  int inside = 0;
  for (const Vec3& direction : {through, axis(1), axis(2)}) {
    const auto hits = input_.surface.all_hits(behind, direction, kFar);
    inside += windings(input_.surface, hits, direction).front() != 0;
  }
  return inside >= 2;
}

std::optional<SurfaceHit> SurfaceProbe::nearest_wall(const Vec3& p, double reach) const {
  if (!has_inner_walls_) return input_.surface.nearest(p, reach);
  return input_.surface.nearest(p, reach, [&](const SurfaceHit& h) { return !is_inner(p, h); });
}

double SurfaceProbe::radius(const Vec3& p, double most) const {
  const double bound = most < kFar ? most * (1 + kRounding) : hull(p) + 2 * input_.pixel;
  auto hit = nearest_wall(p, bound);
  if (!hit) hit = nearest_wall(p, kFar);  // the hull of an open shape may be less than the shape
  return std::max(hit ? hit->distance : hull(p), 1e-6 * diagonal_);
}

std::optional<SurfaceHit> SurfaceProbe::wall(const Vec3& from, const Vec3& direction) const {
  if (!has_inner_walls_) return input_.surface.first_hit(from, direction, kFar);
  const auto hits = input_.surface.all_hits(from, direction, kFar);
  const auto around = windings(input_.surface, hits, direction);
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (around[i + 1] == 0) return hits[i];
  return {};
}

/// The way to a wall that goes on from where it was seen, if that is near and not aslant.
std::optional<double> SurfaceProbe::way_on(const Vec3& from, const Vec3& direction,
                                           const std::optional<SurfaceHit>& seen) const {
  if (!seen) return {};
  const Vec3 normal = input_.surface.normal(seen->triangle);
  const double across = dot(direction, normal);
  if (across * across <= kSteep * kSteep * squared_length(normal)) return {};
  const double way = dot(seen->position - from, normal) / across;
  const double aside = squared_length(from + direction * way - seen->position);
  if (way <= 0 || aside > kAside * kAside * way * way) return {};
  return way;
}

double SurfaceProbe::way_to_wall(const Vec3& from, const Vec3& direction,
                                 std::optional<SurfaceHit>& seen) const {
  if (const auto way = way_on(from, direction, seen)) return *way;
  seen = wall(from, direction);
  return seen ? seen->distance : kFar;
}

Walls SurfaceProbe::walls_across(const Vec3& p, const Vec3& tangent, SeenWalls& seen) const {
  const auto [u, v] = across(tangent);
  const std::array<Vec3, 4> directions{u, (u + v) * kRootHalf, v, (v - u) * kRootHalf};
  Walls walls;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& e = directions[i];
    const double ahead = way_to_wall(p, e, seen[2 * i]), back = way_to_wall(p, -e, seen[2 * i + 1]);
    if (ahead >= kFar || back >= kFar) continue;
    const double nearest = std::min(ahead, back);
    walls.nearest = walls.count == 0 ? nearest : std::min(walls.nearest, nearest);
    walls.pairs[walls.count++] = {e, ahead, back};
  }
  return walls;
}

Section SurfaceProbe::section(const Vec3& p, const Vec3& tangent, const Walls& walls,
                              double radius) const {
  if (walls.count < 2) return {scaled_identity(kUntold), p, 0};
  Symmetric3 told;
  Vec3 pull;
  std::array<double, 4> halves{};
  const double clip = kClip * std::max(radius, kLeastClip * diagonal_);
  for (std::size_t i = 0; i < walls.count; ++i) {
    const Walls::Pair& pair = walls.pairs[i];
    const double ahead = std::min(pair.ahead, clip), back = std::min(pair.back, clip);
    const double half = 0.5 * (ahead + back), off = 0.5 * (ahead - back);
    const double share = radius / half, weight = 0.5 * share * share;
    told = told + outer_square(pair.direction) * weight;
    pull += pair.direction * (weight * off);
    halves[i] = half;
  }
  const Vec3 centre = p + inverse(told + scaled_identity(kSoft)) * pull;
  return {told + outer_square(tangent) * kAlong + scaled_identity(kLeast), centre,
          median(std::span(halves).first(walls.count))};
}

double SurfaceProbe::ahead(const Vec3& p, const Vec3& direction) const {
  constexpr double kSpread = 0.35;  // of the cone: 20 degrees
  const auto [u, v] = across(direction);
  constexpr double kHalf = 0.5, kRoot3Half = 0.86602540378443865;
  const std::array<Vec3, 7> cone{Vec3{},
                                 u,
                                 u * kHalf + v * kRoot3Half,
                                 v * kRoot3Half - u * kHalf,
                                 -u,
                                 -(u * kHalf + v * kRoot3Half),
                                 u * kHalf - v * kRoot3Half};
  std::array<double, 7> ways{};
  for (std::size_t i = 0; i < cone.size(); ++i)
    ways[i] = free_way(p, normalized(direction + cone[i] * kSpread));
  return median(ways);
}

double SurfaceProbe::free_way(const Vec3& p, const Vec3& direction) const {
  std::optional<SurfaceHit> seen;
  return way_to_wall(p, direction, seen);
}

std::vector<Way> SurfaceProbe::free_ways(const Vec3& p, const Vec3& limb) const {
  std::vector<Way> ways;
  for (const Vec3& line : fine_hemisphere_directions())
    for (const Vec3& e : {line, -line})
      if (dot(e, limb) >= kBack) ways.push_back({e, free_way(p, e)});
  return ways;
}

bool SurfaceProbe::is_outside(const Vec3& p) const {
  int escapes = 0, inside = 0;
  if (input_.shape.oriented) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto hits = input_.surface.all_hits(p, axis(i), kFar);
      inside += windings(input_.surface, hits, axis(i)).front() != 0;
      if (i == 0 && inside == 1) return false;
    }
    return inside < 2;
  }
  for (std::size_t i = 0; i < 12; ++i)
    escapes += !input_.surface.first_hit(p, axis(i), kFar).has_value();
  if (escapes == 0) return false;
  for (std::size_t i = 0; i < 7; ++i)
    inside += input_.surface.all_hits(p, axis(i), kFar).size() % 2 == 1;
  return inside <= 2 || (escapes >= 4 && inside <= 3);
}

std::optional<Vec3> SurfaceProbe::inside_near(const Vec3& p) const {
  const auto near = input_.surface.nearest(p, kFar);
  if (!near || near->distance == 0) return {};
  const Vec3 through = (near->position - p) / near->distance;
  const double off = kBehind * diagonal_;
  const auto behind = wall(near->position + through * off, through);
  if (!behind) return {};
  const double depth = std::min(behind->distance, kThinWall * diagonal_);
  return near->position + through * (0.5 * (depth + off));
}

bool SurfaceProbe::is_blocked(const Vec3& a, const Vec3& b) const {
  const double way = distance(a, b);
  return way > 0 && free_way(a, (b - a) / way) < way;
}

}  // namespace marrow
