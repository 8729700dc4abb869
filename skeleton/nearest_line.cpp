#include <algorithm>

#include "nearest_line_detail.hpp"

namespace marrow {

namespace {

constexpr double kSlack = 1e-12;  // more than rounding, where all coordinates are near 1

}  // namespace

Lines::Lines(const CurveSkeleton& skeleton, std::span<const Branch> branches, double scale)
    : branches_(branches) {
  balls_.reserve(skeleton.nodes.size());
  for (const auto& n : skeleton.nodes) balls_.push_back({n.position * scale, n.radius * scale});
  for (std::uint32_t b = 0; b < branches.size(); ++b) {
    const auto& nodes = branches[b].nodes;
    const std::size_t edges = std::max<std::size_t>(nodes.size() - 1, 1);
    for (std::uint32_t i = 0; i < edges; ++i) {
      const Ball &from = balls_[nodes[i]],
                 &to = balls_[nodes[std::min<std::size_t>(i + 1, nodes.size() - 1)]];
      edges_.push_back({{b, i}, from, to, squared_length(to.middle - from.middle)});
    }
  }
  std::vector<ReachBox> boxes;
  for (const Edge& edge : edges_) {
    ReachBox box{edge.from.middle, edge.from.middle,
                 std::max(edge.from.radius, edge.to.radius) + kSlack};
    box.add(edge.to.middle);
    boxes.push_back(box);
  }
  tree_.emplace(boxes);
}

Lines::Foot Lines::foot_on(const Edge& edge, const Vec3& p) const {
  const Vec3 line = edge.to.middle - edge.from.middle;
  double along = 0;
  if (edge.squared_length > 0)
    along = std::clamp(dot(p - edge.from.middle, line) / edge.squared_length, 0.0, 1.0);
  const Vec3 position = edge.from.middle + along * line;
  const double radius = edge.from.radius + along * (edge.to.radius - edge.from.radius);
  return {position, along, distance(p, position) - radius};
}

Lines::Nearest Lines::nearest(const Vec3& p, std::uint32_t guess) const {
  std::uint32_t best = guess;
  Foot foot = foot_on(edges_[guess], p);
  tree_->any(
      [&](const ReachBox& box) {
        const double reach = box.reach + foot.gap;
        return reach >= 0 && box.squared_distance(p) <= reach * reach;
      },
      [&](std::uint32_t e) {
        const Foot other = foot_on(edges_[e], p);
        if (other.gap < foot.gap || (other.gap == foot.gap && e < best)) best = e, foot = other;
        return false;
      });
  LinePlace place = edges_[best].place;
  if (foot.along > 0.5) ++place.step;
  return {place, best, foot.position, foot.gap};
}

LinePlace Lines::descend(const LinePlace& place, const Vec3& p) const {
  const Branch& branch = branches_[place.branch];
  const auto last = static_cast<std::uint32_t>(branch.nodes.size() - 1);
  const auto distance_at = [&](std::uint32_t step) {
    return squared_length(p - balls_[branch.nodes[step]].middle);
  };
  const auto before = [&](std::uint32_t step) {
    return step > 0 ? step - 1 : branch.is_closed() ? last - 1 : step;
  };
  const auto after = [&](std::uint32_t step) {
    return step < last ? step + 1 : branch.is_closed() ? 1 : step;
  };
  std::uint32_t step = place.step;
  for (double least = distance_at(step);;) {
    const std::uint32_t down = before(step), up = after(step);
    const double at_down = distance_at(down), at_up = distance_at(up);
    if (!(std::min(at_down, at_up) < least)) return {place.branch, step};
    step = at_down <= at_up ? down : up;
    least = std::min(at_down, at_up);
  }
}

}  // namespace marrow
