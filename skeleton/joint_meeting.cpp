#include <algorithm>
#include <map>
#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr double kClear = 1.2;      // radii of the joint: beyond it a limb is alone
constexpr double kSpan = 1.5;       // radii of the joint: what tells where a limb points
constexpr double kLeastSpan = 0.5;  // radii of the joint
constexpr double kFarthest = 2.5;   // radii of the joint: how far it may go
constexpr double kStay = 1;         // weight of the old place
constexpr int kHalvings = 2;

/// The end of a line at a joint; points are counted from there.
struct LineEnd {
  std::size_t line;
  bool at_start;
};

using EndsByJoint = std::map<NodeId, std::vector<LineEnd>>;

EndsByJoint ends_by_joint(const std::vector<BranchLine>& lines) {
  EndsByJoint ends;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    if (lines[l].is_ring) continue;
    if (!lines[l].starts_at_leaf) ends[lines[l].start].push_back({l, true});
    if (!lines[l].ends_at_leaf) ends[lines[l].end].push_back({l, false});
  }
  return ends;
}

/// Where a limb comes out of the ball of its joint, and the way it points back to it.
struct Approach {
  std::size_t point = 0;  ///< of the line, counted from the joint
  Vec3 from, direction;   ///< zero: the limb is too short to tell
};

const LinePoint& point_of(const BranchLine& line, const LineEnd& end, std::size_t i) {
  return end.at_start ? line.points[i] : line.points[line.size() - 1 - i];
}

Approach approach(const BranchLine& line, const LineEnd& end) {
  const LinePoint joint = point_of(line, end, 0);
  const bool ends_in_joint = end.at_start ? !line.ends_at_leaf : !line.starts_at_leaf;
  const std::size_t last = line.size() - 1;
  const LinePoint other = point_of(line, end, last);
  const auto is_clear = [&](std::size_t i) {
    return distance(point_of(line, end, i).position, joint.position) >= kClear * joint.radius;
  };
  const auto is_others = [&](std::size_t i) {
    return ends_in_joint &&
           distance(point_of(line, end, i).position, other.position) < kClear * other.radius;
  };
  std::size_t near = 1;
  while (near < last && !is_clear(near)) ++near;
  std::size_t far = near;
  const Vec3 from = point_of(line, end, near).position;
  while (far < last && !is_others(far + 1) &&
         distance(point_of(line, end, far).position, from) < kSpan * joint.radius)
    ++far;
  const Vec3 back = from - point_of(line, end, far).position;
  const double span = length(back);
  if (!is_clear(near) || span < kLeastSpan * joint.radius) return {near, from, {}};
  return {near, from, back / span};
}

/// The place nearest to all the straight lines on which limbs point to a joint.
Vec3 meeting_place(const Vec3& joint, const std::vector<Approach>& approaches) {
  Symmetric3 told = scaled_identity(kStay);
  Vec3 pull = joint * kStay;
  for (const Approach& a : approaches) {
    if (a.direction == Vec3{}) continue;
    const Symmetric3 across = scaled_identity(1) + outer_square(a.direction) * -1;
    told = told + across;
    pull += across * a.from;
  }
  return inverse(told) * pull;
}

/// Puts the end of a line to its joint's new place; what lay between is gone.
void lead(BranchLine& line, const LineEnd& end, const Approach& a, const LinePoint& joint) {
  std::size_t gone = 0;  // points after the end
  const auto is_behind = [&](std::size_t i) {
    const Vec3 on = point_of(line, end, i + 1).position - point_of(line, end, i).position;
    return i < a.point || dot(point_of(line, end, i).position - joint.position, on) <= 0;
  };
  while (gone + 1 + line.least_edges < line.size() && is_behind(gone + 1)) ++gone;
  const auto offset = static_cast<std::ptrdiff_t>(gone);
  if (end.at_start) {
    line.points.erase(line.points.begin() + 1, line.points.begin() + 1 + offset);
    line.points.front() = joint;
  } else {
    line.points.erase(line.points.end() - 1 - offset, line.points.end() - 1);
    line.points.back() = joint;
  }
}

bool is_open(const Vec3& place, const LinePoint& joint, const std::vector<Approach>& approaches,
             const SurfaceProbe& probe) {
  return !probe.is_blocked(joint.position, place) &&
         std::none_of(approaches.begin(), approaches.end(), [&](const Approach& a) {
           return a.direction != Vec3{} && probe.is_blocked(place, a.from);
         });
}

void meet(std::vector<BranchLine>& lines, const std::vector<LineEnd>& ends,
          const SurfaceProbe& probe) {
  const LinePoint joint = point_of(lines[ends.front().line], ends.front(), 0);
  std::vector<Approach> approaches;
  for (const LineEnd& end : ends) approaches.push_back(approach(lines[end.line], end));
  const auto told = std::count_if(approaches.begin(), approaches.end(),
                                  [](const Approach& a) { return !(a.direction == Vec3{}); });
  if (told < 2) return;
  Vec3 way = meeting_place(joint.position, approaches) - joint.position;
  const double far = length(way), most = kFarthest * joint.radius;
  if (far > most) way = way * (most / far);
  int halvings = 0;
  while (halvings <= kHalvings && !is_open(joint.position + way, joint, approaches, probe)) {
    way = way * 0.5;
    ++halvings;
  }
  if (halvings > kHalvings) return;
  const Vec3 place = joint.position + way;
  const LinePoint moved = measured(place, probe, joint.most + length(way));
  for (std::size_t i = 0; i < ends.size(); ++i)
    lead(lines[ends[i].line], ends[i], approaches[i], moved);
}

}  // namespace

void meet_at_joints(std::vector<BranchLine>& lines, const SurfaceProbe& probe) {
  for (const auto& [joint, ends] : ends_by_joint(lines)) meet(lines, ends, probe);
}

}  // namespace marrow
