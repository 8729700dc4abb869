#include <algorithm>
#include <cmath>
#include <limits>

#include "segment_tree_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr std::uint32_t kLeaf = 4;  ///< segments in a box that is not divided

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

double distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) {
  const Vec3 inside{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                    std::clamp(p.z, low.z, high.z)};
  return distance(p, inside);
}

double distance_to_segment(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double squared = squared_length(along);
  const double t = squared > 0 ? std::clamp(dot(p - from, along) / squared, 0.0, 1.0) : 0;
  return distance(p, from + along * t);
}

}  // namespace

SegmentTree::SegmentTree(const CurveSkeleton& skeleton) {
  for (const auto& [a, b] : skeleton.edges)
    segments_.push_back({skeleton.nodes[a].position, skeleton.nodes[b].position});
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0)
      segments_.push_back({skeleton.nodes[n].position, skeleton.nodes[n].position});
  build(0, static_cast<std::uint32_t>(segments_.size()));
}

void SegmentTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto place = boxes_.size();
  Box box{segments_[begin].from, segments_[begin].from, begin, end, 0};
  for (std::uint32_t i = begin; i < end; ++i)
    for (const Vec3& p : {segments_[i].from, segments_[i].to}) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  boxes_.push_back(box);
  if (end - begin <= kLeaf) return;
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(segments_.begin() + begin, segments_.begin() + middle, segments_.begin() + end,
                   [axis](const Segment& a, const Segment& b) {
                     return component(a.from, axis) / 2 + component(a.to, axis) / 2 <
                            component(b.from, axis) / 2 + component(b.to, axis) / 2;
                   });
  build(begin, middle);
  boxes_[place].second = static_cast<std::uint32_t>(boxes_.size());
  build(middle, end);
}

double SegmentTree::distance_to(const Vec3& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    const Box& box = boxes_[at];
    open.pop_back();
    if (!(distance_to_box(p, box.low, box.high) < nearest)) continue;
    if (box.second == 0) {
      for (std::uint32_t i = box.begin; i < box.end; ++i)
        nearest = std::min(nearest, distance_to_segment(p, segments_[i].from, segments_[i].to));
      continue;
    }
    std::uint32_t near = at + 1, far = box.second;
    if (distance_to_box(p, boxes_[far].low, boxes_[far].high) <
        distance_to_box(p, boxes_[near].low, boxes_[near].high))
      std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return nearest;
}

}  // namespace marrow::skeleton_detail
