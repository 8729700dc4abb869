#include "picture/surface_hits.hpp"

#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <vector>

#include "embree_detail.hpp"
#include "picture/vertex_normals.hpp"

namespace marrow {

struct SurfaceTracer::Scene {
  std::vector<Point3f> points;
  std::vector<Triangle> triangles;
  std::vector<Point3f> normals;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

constexpr float kSameDepth = 2e-6F;  // about the noise of float depths at unit size
constexpr float kSmooth = 0.7F;      // cosine between a triangle and its corner normal: 45 degrees

/// The context of a query with the place where its filter collects.
struct CollectContext {
  EmbreeContext context;  // first, so that a pointer to it is a pointer to the whole
  BundleHits* hits = nullptr;
};

bool is_before(const SurfaceHit& a, const SurfaceHit& b) {
  return std::tie(a.depth, a.element) < std::tie(b.depth, b.element);
}

/// Keeps the kMaxHits nearest, in any order while there is room, as a heap once it is full.
void keep(std::array<SurfaceHit, kMaxHits>& hits, int& count, const SurfaceHit& hit) {
  if (count < kMaxHits) {
    hits[static_cast<std::size_t>(count++)] = hit;
    if (count == kMaxHits) std::make_heap(hits.begin(), hits.end(), is_before);
    return;
  }
  if (!is_before(hit, hits.front())) return;
  std::pop_heap(hits.begin(), hits.end(), is_before);
  hits.back() = hit;
  std::push_heap(hits.begin(), hits.end(), is_before);
}

/// Takes a note of every hit and refuses it, so that the line goes on.
void collect(const RTCFilterFunctionNArguments* args) {
  BundleHits& bundle = *reinterpret_cast<CollectContext*>(args->context)->hits;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    args->valid[i] = 0;
    const SurfaceHit hit{RTCRayN_tfar(args->ray, args->N, i), RTCHitN_primID(args->hit, args->N, i),
                         RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)};
    const unsigned line = RTCRayN_id(args->ray, args->N, i);
    keep(bundle.hits[line], bundle.counts[line], hit);
  }
}

void order_and_thin_out(BundleHits& bundle) {
  for (std::size_t line = 0; line < kBundle; ++line) {
    const auto begin = bundle.hits[line].begin();
    const auto end = begin + bundle.counts[line];
    std::sort(begin, end, is_before);
    const auto last = std::unique(begin, end, [](const SurfaceHit& a, const SurfaceHit& b) {
      return b.depth - a.depth < kSameDepth;
    });
    bundle.counts[line] = static_cast<int>(last - begin);
  }
}

Point3f to_floats(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Points that no triangle uses stay at the origin: they may be anywhere, beyond floats even.
std::vector<Point3f> posed_points(const Shape& shape, const Normalization& pose) {
  std::vector<Point3f> posed(shape.points.size(), Point3f{});
  const auto place = [&](std::size_t i) {
    posed[i] = to_floats(pose.to_normalized(shape.points[i]));
  };
  for (const Triangle& triangle : shape.triangles) {
    for (const std::uint32_t corner : triangle) place(corner);
  }
  if (shape.triangles.empty()) {
    for (std::size_t i = 0; i < posed.size(); ++i) place(i);
  }
  return posed;
}

void* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                 std::size_t count) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
  if (buffer == nullptr) throw Error(ErrorKind::Internal, "render: Embree is out of memory");
  return buffer;
}

void fill_triangles(RTCGeometry geometry, const std::vector<Point3f>& points,
                    const std::vector<Triangle>& triangles) {
  void* corners = new_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, sizeof(Point3f),
                             points.size());
  std::memcpy(corners, points.data(), points.size() * sizeof(Point3f));
  void* indices = new_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, sizeof(Triangle),
                             triangles.size());
  std::memcpy(indices, triangles.data(), triangles.size() * sizeof(Triangle));
}

void fill_discs(RTCGeometry geometry, const std::vector<Point3f>& points, float radius) {
  using Disc = std::array<float, 4>;
  auto* discs = static_cast<Disc*>(
      new_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, sizeof(Disc), points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    discs[i] = {points[i][0], points[i][1], points[i][2], radius};
  }
}

}  // namespace

SurfaceTracer::SurfaceTracer(const Shape& shape, const Normalization& pose, double disc)
    : scene_(std::make_unique<Scene>()) {
  Scene& s = *scene_;
  s.points = posed_points(shape, pose);
  s.triangles = shape.triangles;
  s.normals = vertex_normals(s.points, s.triangles);

  // No "threads=N" here: it would cap TBB for the whole process.
  s.device = rtcNewDevice(nullptr);
  if (s.device == nullptr) throw Error(ErrorKind::Internal, "render: Embree does not start");
  s.scene = rtcNewScene(s.device);
  rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);
  if (s.points.empty()) {
    rtcCommitScene(s.scene);
    return;
  }
  const bool discs = s.triangles.empty();
  RTCGeometry geometry =
      rtcNewGeometry(s.device, discs ? RTC_GEOMETRY_TYPE_DISC_POINT : RTC_GEOMETRY_TYPE_TRIANGLE);
  if (discs) {
    fill_discs(geometry, s.points, static_cast<float>(disc));
  } else {
    fill_triangles(geometry, s.points, s.triangles);
  }
  rtcSetGeometryIntersectFilterFunction(geometry, collect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(s.scene);
  if (rtcGetDeviceError(s.device) != RTC_ERROR_NONE) {
    throw Error(ErrorKind::Internal, "render: Embree does not take the shape");
  }
}

SurfaceTracer::~SurfaceTracer() = default;

void SurfaceTracer::trace(const Bundle& bundle, const Vec3& direction, BundleHits& hits) const {
  alignas(64) std::array<int, kBundle> valid;
  valid.fill(-1);
  const Point3f along = to_floats(direction);
  RTCRayHit16 rays;
  for (unsigned i = 0; i < kBundle; ++i) {
    rays.ray.org_x[i] = bundle.x[i];
    rays.ray.org_y[i] = bundle.y[i];
    rays.ray.org_z[i] = bundle.z[i];
    rays.ray.dir_x[i] = along[0];
    rays.ray.dir_y[i] = along[1];
    rays.ray.dir_z[i] = along[2];
    rays.ray.tnear[i] = 0;
    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
    rays.ray.time[i] = 0;
    rays.ray.mask[i] = ~0U;
    rays.ray.id[i] = i;
    rays.ray.flags[i] = 0;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  hits.counts.fill(0);
  CollectContext context;
  context.hits = &hits;
  intersect_coherent(valid.data(), scene_->scene, context.context, rays);
  order_and_thin_out(hits);
}

std::array<float, 3> SurfaceTracer::normal_at(const SurfaceHit& hit, const Vec3& direction) const {
  const Scene& s = *scene_;
  const Point3f along = to_floats(direction);
  if (s.triangles.empty()) return {-along[0], -along[1], -along[2]};
  const auto dot3 = [](const Point3f& a, const Point3f& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const Triangle& triangle = s.triangles[hit.element];
  Point3f flat = face_normal(s.points, triangle);
  const float size = std::sqrt(dot3(flat, flat));
  for (float& part : flat) part /= size;

  const std::array<float, 3> weights = {1 - hit.u - hit.v, hit.u, hit.v};
  Point3f normal{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point3f& corner = s.normals[triangle[k]];
    const float agree = dot3(corner, flat);
    const bool smooth = std::abs(agree) > kSmooth;
    const float sign = smooth && agree < 0 ? -1.0F : 1.0F;
    for (std::size_t i = 0; i < 3; ++i) {
      normal[i] += weights[k] * sign * (smooth ? corner[i] : flat[i]);
    }
  }
  const float scale = (dot3(normal, along) > 0 ? -1.0F : 1.0F) / std::sqrt(dot3(normal, normal));
  for (float& part : normal) part *= scale;
  return normal;
}

}  // namespace marrow
