// What a SurfaceScene holds, for the sources that send rays through it.
#pragma once

#include <marrow/surface_scene.hpp>

#include "embree_detail.hpp"

namespace marrow {

struct SurfaceScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Embree() = default;
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

}  // namespace marrow
