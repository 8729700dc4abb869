// Medial axes of many images.
#pragma once

#include <marrow/medial_axis.hpp>

#include "sure_removal_detail.hpp"
#include "thinning_detail.hpp"

namespace marrow {

/// medial_axis() with memory that is used again from image to image.
class MedialAxisMaker {
 public:
  MedialAxis operator()(const DistanceMap& map, double prune_pixels = kPrunePixels);

 private:
  ShrinkingSet set_;
  DoubtfulPixels doubtful_;
  PixelOrder order_;
};

}  // namespace marrow
