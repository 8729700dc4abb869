#include <marrow/sheet_leaves.hpp>
#include <marrow/smoothing.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "chord_section_detail.hpp"
#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr double kShort = 1.2;  // half widths of the sheet, from the ball of the joint to the leaf
constexpr double kFlat = 1.5;   // greatest half width, times the median of all directions
constexpr std::array kPlaces{0.25, 0.5, 0.75};  // of the branch outside the ball of its joint
constexpr int kAround = 15, kLeastAround = 8;   // places about the joint: all, and in the sheet
constexpr double kAsThin = 2;           // times the thickness of the sheet, at the most, in it
constexpr double kLongest = 2.7;        // half widths, from the joint across a round sheet
constexpr double kLongestInside = 4.5;  // where all the places are in the sheet
constexpr int kSmoothingPasses = 5;     // lines of voxels wiggle
constexpr std::size_t kReach = 4;       // nodes each way, for the tangent

double middle_one(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

using Sections = std::array<ChordSection, kPlaces.size()>;

/// What lies around a joint in the plane of a sheet: fifteen places as far off as the one that the
/// sheet was seen from.
struct Surroundings {
  int as_thin = 0;     ///< of the fifteen
  double longest = 0;  ///< way past one of them
};

Surroundings look_around(const Vec3& joint, const ChordSection& sheet, const FreeWay& free_way) {
  const Vec3 centre = joint + sheet.normal * dot(sheet.middle - joint, sheet.normal);
  const Vec3 out = sheet.middle - centre;
  const double reach = length(out);
  if (reach == 0) return {};
  const Vec3 u = out / reach, v = cross(sheet.normal, u);
  Surroundings result;
  const auto ways = directions_around(u, v);
  for (const Vec3& way : std::span(ways).subspan(1)) {
    const double free = free_way(centre, way);
    result.longest = std::max(result.longest, free);
    if (free < reach) continue;
    const double half = chord_half(centre + way * reach, sheet.normal, free_way);
    result.as_thin += half <= kAsThin * sheet.thinnest;
  }
  return result;
}

/// A limb that is flat, such as an ear, has the body around its joint; one that forks goes on for
/// long the other way.
bool is_round(const Vec3& joint, const Sections& sections, double widest, const FreeWay& free_way) {
  Surroundings most;
  for (const ChordSection& section : sections) {
    const auto seen = look_around(joint, turned_to_normal(section, free_way), free_way);
    most.as_thin = std::max(most.as_thin, seen.as_thin);
    most.longest = std::max(most.longest, seen.longest);
  }
  const double longest = most.as_thin == kAround ? kLongestInside : kLongest;
  return most.as_thin >= kLeastAround && most.longest <= longest * widest;
}

class SheetPruner {
 public:
  SheetPruner(const VoteGraph& graph, const Projections& projections, const AskSurface& surface)
      : original_(graph),
        smooth_(smooth_branches(graph, kSmoothingPasses)),
        graph_(smooth_),
        projections_(projections),
        in_hull_(free_way_in(projections)),
        surface_(surface),
        was_joint_(graph.nodes.size(), false),
        verdicts_(graph.nodes.size()) {}

  VoteGraph prune() {
    while (const auto branch = shortest_in_sheet()) {
      for (const NodeId n : branch->nodes) graph_.remove_node(n), original_.remove_node(n);
      was_joint_[branch->joint] = true;
    }
    return original_.result();
  }

 private:
  /// What was found of the branch of a leaf.
  struct Verdict {
    NodeId joint = 0;
    double share = kShort;  ///< of the sheet's half width; kShort where there is none
  };

  /// A line through a sheet on its own stays, and so does one end of it if the other goes.
  bool may_be_cut(const LeafBranch& branch) const {
    if (graph_.degree(branch.joint) != 2) return graph_.degree(branch.joint) > 2;
    for (NodeId n = 0; n < graph_.size(); ++n) {
      if (n == branch.leaf() || !graph_.alive(n) || graph_.degree(n) != 1) continue;
      if (trace(n).joint == branch.joint && verdicts_[n]->share < kShort) return false;
    }
    return true;
  }

  std::optional<LeafBranch> shortest_in_sheet() {
    std::vector<LeafBranch> branches;
    for (NodeId n = 0; n < graph_.size(); ++n)
      if (graph_.alive(n) && graph_.degree(n) == 1) branches.push_back(trace(n));
    for (const LeafBranch& branch : branches) {
      auto& verdict = verdicts_[branch.leaf()];
      if (!verdict || verdict->joint != branch.joint) verdict = judge(branch);
    }
    std::optional<LeafBranch> shortest;
    double least = kShort;
    for (LeafBranch& branch : branches) {
      const double share = verdicts_[branch.leaf()]->share;
      if (share < least && may_be_cut(branch)) least = share, shortest = std::move(branch);
    }
    return shortest;
  }

  /// Like trace_leaf_branch(), but what was a joint still ends a branch.
  LeafBranch trace(NodeId leaf) const {
    LeafBranch branch = trace_leaf_branch(graph_, leaf);
    for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
      if (!was_joint_[branch.nodes[i]]) continue;
      branch.joint = branch.nodes[i];
      branch.ends_at_joint = true;
      branch.nodes.resize(i);
      break;
    }
    return branch;
  }

  /// The part of a branch outside the ball of its joint.
  struct Beyond {
    std::vector<std::size_t> places;
    double extent = 0;  ///< of the farthest, from the ball
  };

  Beyond beyond_ball(const LeafBranch& branch) const {
    const Vec3 joint = graph_.node(branch.joint).position;
    const double ball = std::max(hull_radius(joint, projections_), 0.0);
    Beyond beyond;
    for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
      const double way = distance(graph_.node(branch.nodes[i]).position, joint) - ball;
      if (way > 0) beyond.places.push_back(i);
      beyond.extent = std::max(beyond.extent, way);
    }
    return beyond;
  }

  Verdict judge(const LeafBranch& branch) const {
    Verdict verdict{branch.joint};
    if (!branch.ends_at_joint) return verdict;
    const Vec3 joint = graph_.node(branch.joint).position;
    const Beyond beyond = beyond_ball(branch);
    const std::vector<std::size_t>& outside = beyond.places;
    const double extent = beyond.extent;
    if (outside.empty()) return verdict;
    const auto sections = [&](const FreeWay& free_way) {
      Sections result;
      for (std::size_t k = 0; k < kPlaces.size(); ++k) {
        const double at = kPlaces[k] * static_cast<double>(outside.size() - 1);
        result[k] = section_at(branch, outside[static_cast<std::size_t>(at)], free_way);
      }
      return result;
    };
    // The hull is asked first, for that costs less; limbs side by side are a sheet to it.
    if (!is_short_and_flat(extent, sections(in_hull_))) return verdict;
    const FreeWay in_surface = free_way_in(surface_(), projections_);
    const Sections found = sections(in_surface);
    if (is_short_and_flat(extent, found) && is_round(joint, found, widest(found), in_surface))
      verdict.share = extent / widest(found);
    return verdict;
  }

  static double widest(const Sections& s) {
    return middle_one(s[0].widest, s[1].widest, s[2].widest);
  }
  static bool is_short_and_flat(double extent, const Sections& s) {
    const double median = middle_one(s[0].median, s[1].median, s[2].median);
    return extent < kShort * widest(s) && widest(s) >= kFlat * median;
  }

  /// From leaf to joint the places grow.
  ChordSection section_at(const LeafBranch& branch, std::size_t place,
                          const FreeWay& free_way) const {
    const auto position = [&](std::size_t i) {
      return graph_.node(i < branch.nodes.size() ? branch.nodes[i] : branch.joint).position;
    };
    const Vec3 way = position(place - std::min(place, kReach)) - position(place + kReach);
    return way == Vec3{} ? ChordSection{}
                         : section_across(position(place), normalized(way), free_way);
  }

  LiveGraph original_;
  const VoteGraph smooth_;
  LiveGraph graph_;  // of the smooth one
  const Projections& projections_;
  const FreeWay in_hull_;
  const AskSurface& surface_;
  std::vector<bool> was_joint_;
  std::vector<std::optional<Verdict>> verdicts_;  // of leaves
};

}  // namespace

VoteGraph cut_leaves_in_sheets(const VoteGraph& graph, const Projections& projections,
                               const AskSurface& surface) {
  return SheetPruner(graph, projections, surface).prune();
}

}  // namespace marrow
