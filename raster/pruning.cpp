#include <bit>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "thinning_detail.hpp"

namespace marrow {

namespace {

using Pixel = ShrinkingSet::Pixel;

/// An end branch of a thin set: its pixels from the end on, without the joint.
struct EndBranch {
  std::vector<Pixel> pixels;
  Pixel joint = 0;
  bool ends_at_joint = false;
};

/// The neighbours of `p` in the set, as bits around it.
unsigned neighbours(const ShrinkingSet& set, Pixel p) {
  return static_cast<unsigned>(set.around(p)) & 0x1ef;
}

bool is_end(const ShrinkingSet& set, Pixel p) {
  return set.contains(p) && std::has_single_bit(neighbours(set, p));
}

/// Walks from an end through pixels with two neighbours to the first that has more.
EndBranch trace(const ShrinkingSet& set, Pixel end) {
  EndBranch branch;
  Pixel here = end;
  unsigned on = neighbours(set, end);
  do {
    branch.pixels.push_back(here);
    if (on == 0) return branch;  // the other end
    const auto bit = static_cast<unsigned>(std::countr_zero(on));
    here = set.neighbour(here, bit);
    const unsigned all = neighbours(set, here);
    if (std::popcount(all) > 2) break;
    on = all & ~(1u << (8 - bit));
  } while (true);
  branch.joint = here;
  branch.ends_at_joint = true;
  return branch;
}

/// How much farther than the joint's disc the end's disc reaches, in pixels.
double reach(const ShrinkingSet& set, Pixel end, Pixel joint) {
  const double dx = set.x_of(end) - set.x_of(joint), dy = set.y_of(end) - set.y_of(joint);
  return std::sqrt(dx * dx + dy * dy) + pixels_of(set.distance(end)) -
         pixels_of(set.distance(joint));
}

struct Candidate {
  double reach;
  Pixel end, joint;

  bool operator>(const Candidate& o) const {
    return std::tie(reach, end, joint) > std::tie(o.reach, o.end, o.joint);
  }
};

}  // namespace

void prune_end_branches(ShrinkingSet& axis, double most) {
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  const auto consider = [&](Pixel end) {
    const EndBranch branch = trace(axis, end);
    if (!branch.ends_at_joint) return;
    const double tells = reach(axis, end, branch.joint);
    if (tells <= most) queue.push({tells, end, branch.joint});
  };
  for (const auto p : pixels(axis))
    if (is_end(axis, p)) consider(p);
  while (!queue.empty()) {
    const Candidate c = queue.top();
    queue.pop();
    if (!is_end(axis, c.end)) continue;
    const EndBranch branch = trace(axis, c.end);
    if (!branch.ends_at_joint) continue;
    // Another branch of its joint may have gone, so that this one now runs on.
    if (branch.joint != c.joint) {
      consider(c.end);
      continue;
    }
    for (const auto p : branch.pixels) axis.remove(p);
    if (is_end(axis, branch.joint)) consider(branch.joint);
  }
  thin_to_unit_width(axis, pixels(axis));
}

}  // namespace marrow
