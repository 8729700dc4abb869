// Embree 3 or 4, whichever the system has: the few names that differ between them.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define MARROW_EMBREE 4
#else
#include <embree3/rtcore.h>
#define MARROW_EMBREE 3
#endif

namespace marrow {

#if MARROW_EMBREE == 4
using EmbreeContext = RTCRayQueryContext;

/// Sixteen rays that run together. `context` reaches the filters as args->context.
inline void intersect_coherent(const int* valid, RTCScene scene, EmbreeContext& context,
                               RTCRayHit16& rays) {
  rtcInitRayQueryContext(&context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  arguments.context = &context;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

/// Whether anything is in the way of sixteen rays: tfar of those becomes -infinity.
inline void occlude(const int* valid, RTCScene scene, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &rays, nullptr);
}

/// One ray. `context` reaches the filter as args->context.
inline void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray,
                      RTCFilterFunctionN filter) {
  rtcInitRayQueryContext(&context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_INCOHERENT |
                                                  RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  arguments.context = &context;
  arguments.filter = filter;
  rtcIntersect1(scene, &ray, &arguments);
}
#else
using EmbreeContext = RTCIntersectContext;

/// Sixteen rays that run together. `context` reaches the filters as args->context.
inline void intersect_coherent(const int* valid, RTCScene scene, EmbreeContext& context,
                               RTCRayHit16& rays) {
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
}

/// Whether anything is in the way of sixteen rays: tfar of those becomes -infinity.
inline void occlude(const int* valid, RTCScene scene, RTCRay16& rays) {
  EmbreeContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, scene, &context, &rays);
}

/// One ray. `context` reaches the filter as args->context.
inline void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray,
                      RTCFilterFunctionN filter) {
  rtcInitIntersectContext(&context);
  context.filter = filter;
  rtcIntersect1(scene, &context, &ray);
}
#endif

}  // namespace marrow
