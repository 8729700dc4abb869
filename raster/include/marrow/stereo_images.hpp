// What one stereo pair of views sees (section 4.1).
#pragma once

#include <marrow/medial_axis.hpp>
#include <marrow/silhouette.hpp>

namespace marrow {

/// One image of a pair: the silhouette, its distances, its medial axis and the way to it.
struct ViewImage {
  ViewPlane plane;
  BitImage silhouette;
  DistanceMap distance;
  MedialAxis axis;
  /// Distances to the nearest pixel of the medial axis, in the silhouette and next to it.
  BoxedDistanceMap to_axis;
};

/// Two images that share their rows.
struct StereoImages {
  StereoPair pair;
  ViewImage front, side;
};

/// The frame of the pair that looks along `direction`: its scanline axis y is the major axis of a
/// small silhouette, x the minor one.
StereoPair stereo_pair(const NormalizedShape& shape, const Vec3& direction);

/// Draws both images of a pair, by rays where `scene` is given, and takes their medial axes.
StereoImages draw_stereo_images(const NormalizedShape& shape, const StereoPair& pair,
                                int resolution, const SurfaceScene* scene = nullptr);

/// Those of many pairs, which is faster together.
std::vector<StereoImages> draw_stereo_images(const NormalizedShape& shape,
                                             std::span<const StereoPair> pairs, int resolution,
                                             const SurfaceScene* scene = nullptr,
                                             const ForEach& for_each = for_each_in_turn);

}  // namespace marrow
