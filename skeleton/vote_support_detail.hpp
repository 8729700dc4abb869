// How many images see a vote near their medial axis.
#pragma once

#include <marrow/visual_hull.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

/// The way to the medial axis of an image, where a vote may stand in it.
class SupportImage {
 public:
  static constexpr std::uint16_t kOutside = 0xffff;

  /// Votes may stand where `mask` holds them.
  SupportImage(const ViewImage& image, const BitImage& mask);

  int left, top, width, height;
  /// At 1 + x - left + width * (y - top); kOutside at 0, and where no vote may stand.
  std::vector<std::uint16_t> away;
};

/// What all images say of a vote.
struct VoteSupport {
  std::int32_t narrow = 0, broad = 0;  ///< images that are so near
  bool is_inside = false;              ///< in all; the counts hold only then
};

/// For every position: images no farther away than `narrow`, and than its own `broad`.
std::vector<VoteSupport> vote_support(const Projections& project,
                                      std::span<const SupportImage> images,
                                      std::span<const Vec3> positions, std::int32_t narrow,
                                      std::span<const std::int32_t> broad);

}  // namespace marrow
