#include <marrow/surface_scene.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "surface_scene_detail.hpp"

namespace marrow {

namespace {

// Embree computes in floats: a triangle that it puts this much farther away may be the nearest.
constexpr double kRelativeSlack = 1e-5, kSlack = 1e-6;

double with_slack(double distance) { return distance * (1 + kRelativeSlack) + kSlack; }

struct Corners {
  Vec3 a, b, c;
};

Corners corners_of(const NormalizedShape& shape, std::uint32_t triangle) {
  const auto point = [&](std::uint32_t i) {
    return Vec3{double{shape.x[i]}, double{shape.y[i]}, double{shape.z[i]}};
  };
  const Triangle& t = shape.triangles[triangle];
  return {point(t[0]), point(t[1]), point(t[2])};
}

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 span = b - a;
  const double squared = squared_length(span);
  return squared > 0 ? a + span * std::clamp(dot(p - a, span) / squared, 0.0, 1.0) : a;
}

Vec3 nearest_on_edges(const Vec3& p, const Corners& t) {
  Vec3 nearest = nearest_on_segment(p, t.a, t.b);
  for (const Vec3& q : {nearest_on_segment(p, t.b, t.c), nearest_on_segment(p, t.c, t.a)})
    if (squared_length(q - p) < squared_length(nearest - p)) nearest = q;
  return nearest;
}

/// `normal` is that of the triangle, of any length.
Vec3 nearest_on_triangle(const Vec3& p, const Corners& t, const Vec3& normal) {
  const double squared = squared_length(normal);
  const auto is_left_of = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(to - from, p - from), normal) >= 0;
  };
  if (squared > 0 && is_left_of(t.a, t.b) && is_left_of(t.b, t.c) && is_left_of(t.c, t.a))
    return p - normal * (dot(p - t.a, normal) / squared);
  return nearest_on_edges(p, t);
}

bool is_before(const SurfaceHit& a, const SurfaceHit& b) {
  return std::tie(a.distance, a.triangle) < std::tie(b.distance, b.triangle);
}

/// A search for the nearest point; narrows as it goes.
struct PointSearch {
  const NormalizedShape& shape;
  Vec3 from;
  double reach;
  const std::function<bool(const SurfaceHit&)>& counts;
  std::optional<SurfaceHit> best;

  /// Looks at one triangle; whether the search has become narrower.
  bool visit(std::uint32_t triangle) {
    const Corners t = corners_of(shape, triangle);
    const Vec3 normal = cross(t.b - t.a, t.c - t.a);
    const double height = dot(from - t.a, normal);
    const double limit = with_slack(best ? best->distance : reach);
    if (height * height > limit * limit * squared_length(normal)) return false;  // so is its plane
    const Vec3 q = nearest_on_triangle(from, t, normal);
    const SurfaceHit hit{distance(q, from), triangle, q};
    if (hit.distance > reach || (best && !is_before(hit, *best))) return false;
    if (counts && !counts(hit)) return false;
    best = hit;
    return true;
  }
};

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<PointSearch*>(arguments->userPtr);
  if (!search.visit(arguments->primID)) return false;
  arguments->query->radius = static_cast<float>(with_slack(search.best->distance));
  return true;
}

/// A ray and what it meets; the context is what Embree hands to the filter.
struct RaySearch {
  EmbreeContext context;
  const NormalizedShape* shape;
  Vec3 from, direction;
  double reach;
  std::optional<SurfaceHit> best;
  std::vector<SurfaceHit>* all = nullptr;  // where every hit is wanted

  std::optional<SurfaceHit> hit(std::uint32_t triangle) const {
    const Corners t = corners_of(*shape, triangle);
    const Vec3 normal = cross(t.b - t.a, t.c - t.a);
    const double across = dot(normal, direction);
    if (across == 0) return {};
    const double distance = dot(t.a - from, normal) / across;
    if (!(distance >= 0) || distance > reach) return {};
    return SurfaceHit{distance, triangle, from + direction * distance};
  }
};

static_assert(std::is_standard_layout_v<EmbreeContext>);

/// Takes the hit that Embree found. Embree goes on up to a little behind the best one, so that
/// which of two near hits it finds first is nothing.
void take_hit(const RTCFilterFunctionNArguments* arguments) {
  auto& search = *reinterpret_cast<RaySearch*>(
      const_cast<EmbreeContext*>(arguments->context));  // its first member
  const auto hit = search.hit(RTCHitN_primID(arguments->hit, arguments->N, 0));
  if (hit && search.all != nullptr) search.all->push_back(*hit);
  if (!hit || search.all != nullptr) {
    arguments->valid[0] = 0;
    return;
  }
  if (!search.best || is_before(*hit, *search.best)) search.best = hit;
  RTCRayN_tfar(arguments->ray, arguments->N, 0) =
      static_cast<float>(with_slack(search.best->distance));
}

void run(RTCScene scene, RaySearch& search) {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(search.from.x);
  ray.ray.org_y = static_cast<float>(search.from.y);
  ray.ray.org_z = static_cast<float>(search.from.z);
  ray.ray.dir_x = static_cast<float>(search.direction.x);
  ray.ray.dir_y = static_cast<float>(search.direction.y);
  ray.ray.dir_z = static_cast<float>(search.direction.z);
  ray.ray.tfar = static_cast<float>(with_slack(search.reach));
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(scene, search.context, ray, take_hit);
}

}  // namespace

std::optional<SurfaceHit> SurfaceScene::nearest(
    const Vec3& p, double reach, const std::function<bool(const SurfaceHit&)>& counts) const {
  PointSearch search{shape_, p, reach, counts, {}};
  RTCPointQuery query{};
  query.x = static_cast<float>(p.x);
  query.y = static_cast<float>(p.y);
  query.z = static_cast<float>(p.z);
  query.radius = static_cast<float>(with_slack(reach));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embree_->scene, &query, &context, visit_triangle, &search);
  return search.best;
}

std::optional<SurfaceHit> SurfaceScene::first_hit(const Vec3& from, const Vec3& direction,
                                                  double reach) const {
  RaySearch search{{}, &shape_, from, direction, reach, {}, nullptr};
  run(embree_->scene, search);
  return search.best;
}

std::vector<SurfaceHit> SurfaceScene::all_hits(const Vec3& from, const Vec3& direction,
                                               double reach) const {
  std::vector<SurfaceHit> hits;
  RaySearch search{{}, &shape_, from, direction, reach, {}, &hits};
  run(embree_->scene, search);
  std::sort(hits.begin(), hits.end(), is_before);
  return hits;
}

Vec3 SurfaceScene::normal(std::uint32_t triangle) const {
  const Corners t = corners_of(shape_, triangle);
  return cross(t.b - t.a, t.c - t.a);
}

}  // namespace marrow
