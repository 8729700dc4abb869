#include <marrow/sheet_leaves.hpp>
#include <marrow/smoothing.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "chord_section_detail.hpp"
#include "live_graph_detail.hpp"

namespace marrow {

namespace {

constexpr double kShort = 2.2;  // half widths of the sheet, from the ball of the joint to the leaf
constexpr double kFlat = 1.5;   // greatest half width, times the median of all directions
constexpr std::array kPlaces{0.25, 0.5, 0.75};  // of the branch outside the ball of its joint
constexpr std::size_t kRim = 13;                // places on the rim, 11.25 degrees apart
constexpr double kStraight = 0.1;               // sine of a turn that is none
constexpr int kSmoothingPasses = 5;             // lines of voxels wiggle
constexpr std::size_t kReach = 4;               // nodes each way, for the tangent

double middle_one(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

using Sections = std::array<ChordSection, kPlaces.size()>;

/// Whether the rim of a sheet has no notch within 67.5 degrees of one place of it, seen from a
/// joint. There is one beside a limb, such as an ear, and between the lobes of a fork.
bool is_rim_convex(const Vec3& joint, const ChordSection& sheet, const FreeWay& free_way) {
  const Vec3 centre = joint + sheet.normal * dot(sheet.middle - joint, sheet.normal);
  const Vec3 out = sheet.middle - centre;
  if (out == Vec3{}) return false;
  const Vec3 u = normalized(out);
  const auto ways = directions_around(u, cross(sheet.normal, u));
  std::array<Vec3, kRim> rim;
  for (std::size_t k = 0; k < kRim; ++k) {
    // Half-way between those directions too.
    const std::size_t twice = 2 * ways.size() - kRim / 2 + k;
    const Vec3 way =
        normalized(ways[twice / 2 % ways.size()] + ways[(twice + 1) / 2 % ways.size()]);
    rim[k] = way * free_way(centre, way);
  }
  for (std::size_t k = 1; k + 1 < kRim; ++k) {
    const Vec3 before = rim[k] - rim[k - 1], behind = rim[k + 1] - rim[k];
    const double turn = dot(cross(before, behind), sheet.normal);
    if (turn < -kStraight * length(before) * length(behind)) return false;
  }
  return true;
}

bool is_rim_convex(const Vec3& joint, const Sections& sections, const FreeWay& free_way) {
  return std::any_of(sections.begin(), sections.end(), [&](const ChordSection& section) {
    return is_rim_convex(joint, turned_to_normal(section, free_way), free_way);
  });
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
    if (is_short_and_flat(extent, found) && is_rim_convex(joint, found, in_surface))
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
