#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "thinning_detail.hpp"

namespace marrow {

namespace {

/// An end branch of a thin set: its pixels from the end on, without the joint.
struct EndBranch {
  std::vector<std::uint32_t> pixels;
  std::uint32_t joint = 0;
  bool ends_at_joint = false;
};

class ThinSet {
 public:
  ThinSet(PixelSet& set, const DistanceMap& map) : set_(set), map_(map), width_(set.width()) {}

  /// Set neighbours of a pixel, those along rows and columns first.
  int neighbours(std::uint32_t i, std::array<std::uint32_t, 8>& out) const {
    const std::ptrdiff_t w = width_;
    int count = 0;
    for (const std::ptrdiff_t o :
         {std::ptrdiff_t{1}, -w, std::ptrdiff_t{-1}, w, 1 - w, -1 - w, w - 1, w + 1}) {
      const auto n = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + o);
      if (set_.pixels()[n]) out[static_cast<std::size_t>(count++)] = n;
    }
    return count;
  }

  /// All pixels that are set, row by row.
  std::vector<std::uint32_t> pixels() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < set_.pixels().size(); ++i)
      if (set_.pixels()[i]) result.push_back(i);
    return result;
  }

  bool is_end(std::uint32_t i) const {
    std::array<std::uint32_t, 8> n;
    return set_.pixels()[i] && neighbours(i, n) == 1;
  }

  /// Walks from an end through pixels with two neighbours to the first that has more.
  EndBranch trace(std::uint32_t end) const {
    EndBranch branch;
    std::uint32_t previous = end, here = end;
    for (;;) {
      branch.pixels.push_back(here);
      std::array<std::uint32_t, 8> n;
      const int count = neighbours(here, n);
      std::uint32_t next = here;
      for (int k = 0; k < count; ++k)
        if (n[static_cast<std::size_t>(k)] != previous) next = n[static_cast<std::size_t>(k)];
      if (next == here) return branch;  // the other end
      previous = here;
      here = next;
      if (neighbours(here, n) > 2) break;
    }
    branch.joint = here;
    branch.ends_at_joint = true;
    return branch;
  }

  /// How much farther than the joint's disc the end's disc reaches, in pixels.
  double reach(std::uint32_t end, std::uint32_t joint) const {
    const double dx = x_of(end) - x_of(joint), dy = y_of(end) - y_of(joint);
    return std::sqrt(dx * dx + dy * dy) + pixels_of(map_.pixels()[end]) -
           pixels_of(map_.pixels()[joint]);
  }

  void remove(const EndBranch& branch) {
    for (const auto i : branch.pixels) set_.pixels()[i] = 0;
  }

 private:
  int x_of(std::uint32_t i) const { return static_cast<int>(i) % width_; }
  int y_of(std::uint32_t i) const { return static_cast<int>(i) / width_; }

  PixelSet& set_;
  const DistanceMap& map_;
  int width_;
};

struct Candidate {
  double reach;
  std::uint32_t end, joint;

  bool operator>(const Candidate& o) const {
    return std::tie(reach, end, joint) > std::tie(o.reach, o.end, o.joint);
  }
};

}  // namespace

void prune_end_branches(PixelSet& axis, const DistanceMap& map, double pixels) {
  ThinSet set(axis, map);
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  const auto consider = [&](std::uint32_t end) {
    const EndBranch branch = set.trace(end);
    if (!branch.ends_at_joint) return;
    const double reach = set.reach(end, branch.joint);
    if (reach <= pixels) queue.push({reach, end, branch.joint});
  };
  for (std::uint32_t i = 0; i < axis.pixels().size(); ++i)
    if (set.is_end(i)) consider(i);
  while (!queue.empty()) {
    const Candidate c = queue.top();
    queue.pop();
    if (!set.is_end(c.end)) continue;
    const EndBranch branch = set.trace(c.end);
    if (!branch.ends_at_joint) continue;
    // Another branch of its joint may have gone, so that this one now runs on.
    if (branch.joint != c.joint) {
      consider(c.end);
      continue;
    }
    set.remove(branch);
    if (set.is_end(branch.joint)) consider(branch.joint);
  }
  thin_to_unit_width(axis, set.pixels());
}

}  // namespace marrow
