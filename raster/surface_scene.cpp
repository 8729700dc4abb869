#include <marrow/error.hpp>
#include <marrow/surface_scene.hpp>

#include <array>

#include "surface_scene_detail.hpp"

namespace marrow {

namespace {

// Embree fuses multiplications with additions from AVX2 on, and border pixels would come out
// otherwise than on machines without. No "threads=N" here: it would cap TBB for the whole process.
constexpr const char* kDevice = "max_isa=avx";

// From here on building the tree takes longer than tracing through it does.
constexpr std::size_t kManyTriangles = 200'000;

// The filter of a ray is asked only where the scene has been told that there may be one. A compact
// tree takes half the memory and no more time: 107 MB for 2,000,000 triangles instead of 200.
#if MARROW_EMBREE == 4
const RTCSceneFlags kSceneFlags = static_cast<RTCSceneFlags>(
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
#else
const RTCSceneFlags kSceneFlags = static_cast<RTCSceneFlags>(
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
#endif

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ErrorKind::Limit,
                "the memory does not hold Embree's tree of the shape; silhouettes by scanline do "
                "without it");
  if (error != RTC_ERROR_NONE) throw Error(ErrorKind::Internal, "Embree does not take the shape");
}

void set_points(RTCDevice device, RTCGeometry geometry, const NormalizedShape& shape) {
  using Point = std::array<float, 3>;
  auto* points = static_cast<Point*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Point), shape.x.size()));
  check(device);
  for (std::size_t i = 0; i < shape.x.size(); ++i) points[i] = {shape.x[i], shape.y[i], shape.z[i]};
}

void add_triangles(const SurfaceScene::Embree& embree, const NormalizedShape& shape,
                   SurfaceScene::Use use) {
  const bool is_worth_it =
      use == SurfaceScene::Use::Images && shape.triangles.size() < kManyTriangles;
  const auto quality = is_worth_it ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW;
  rtcSetSceneBuildQuality(embree.scene, quality);
  RTCGeometry geometry = rtcNewGeometry(embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcAttachGeometry(embree.scene, geometry);
  rtcReleaseGeometry(geometry);  // the scene keeps it
  set_points(embree.device, geometry, shape);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             shape.triangles.data(), 0, sizeof(Triangle), shape.triangles.size());
  rtcSetGeometryBuildQuality(geometry, quality);
  rtcCommitGeometry(geometry);
}

[[noreturn]] void fail_to_start() {
  if (rtcGetDeviceError(nullptr) == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ErrorKind::Limit, "there is no memory for Embree; simplify the shape");
  throw Error(ErrorKind::Internal, "Embree does not start");
}

}  // namespace

SurfaceScene::SurfaceScene(const NormalizedShape& shape, Use use)
    : shape_(shape), embree_(std::make_unique<Embree>()) {
  Embree& e = *embree_;
  e.device = rtcNewDevice(kDevice);
  if (e.device == nullptr) fail_to_start();
  e.scene = rtcNewScene(e.device);
  rtcSetSceneFlags(e.scene, kSceneFlags);
  if (!shape.triangles.empty()) add_triangles(e, shape, use);
  rtcCommitScene(e.scene);
  check(e.device);
}

SurfaceScene::~SurfaceScene() = default;

}  // namespace marrow
