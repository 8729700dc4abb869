// The nearest of many line segments.
#pragma once

#include <marrow/curve_skeleton.hpp>

#include <vector>

namespace marrow::skeleton_detail {

/// The edges and lone nodes of a skeleton in a tree of boxes.
class SegmentTree {
 public:
  /// The skeleton has nodes.
  explicit SegmentTree(const CurveSkeleton& skeleton);

  double distance_to(const Vec3& p) const;

 private:
  struct Segment {
    Vec3 from, to;
  };
  struct Box {
    Vec3 low, high;
    std::uint32_t begin = 0, end = 0;  ///< segments
    std::uint32_t second = 0;          ///< of its two halves; the first follows it; 0: a leaf
  };

  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Segment> segments_;
  std::vector<Box> boxes_;
};

}  // namespace marrow::skeleton_detail
