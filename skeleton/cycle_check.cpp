#include <marrow/cycle_check.hpp>
#include <marrow/smoothing.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "branch_graph_detail.hpp"
#include "excursion_detail.hpp"

namespace marrow {

namespace {

constexpr int kSmoothingPasses = 5;     // before the surface is asked
constexpr double kHollowVoxels = 6;     // from the surface: what is farther outside is a hollow
constexpr double kGrazingVoxels = 0.3;  // a well supported thin limb may leave the surface so far
constexpr int kWeakSupport = kImages / 2;
constexpr int kSamplesPerEdge = 4;
constexpr double kInsideShare = 0.9;  // of a disc's samples, for it to lie inside
constexpr double kOutsideShare = 0.02;

using Support = std::tuple<int, double>;  // least support, then length: the least goes first

std::optional<int> least_supported(const BranchGraph& graph, const std::vector<int>& links) {
  const auto support = [&](int link) {
    return Support(graph.least_support(link), graph.length(link));
  };
  const auto least = std::min_element(links.begin(), links.end(),
                                      [&](int a, int b) { return support(a) < support(b); });
  return least == links.end() ? std::nullopt : std::optional(*least);
}

/// What the surface says of a cycle through a link; it holds until one of its links changes.
struct CycleVerdict {
  std::vector<int> cycle;
  bool spans_disc_inside = false;
};

class CycleCheck {
 public:
  // The lines of voxels wiggle and would leave thin limbs here and there: the surface is asked
  // along the smoothed ones, which have the same links.
  CycleCheck(const VoteGraph& graph, SurfaceSides& surface, double voxel)
      : graph_(graph),
        smooth_(smooth_branches(graph, kSmoothingPasses)),
        surface_(surface),
        voxel_(voxel),
        outside_(static_cast<std::size_t>(smooth_.link_count())),
        changed_(outside_.size()),
        bridge_(smooth_.bridges()),
        place_of_(outside_.size()),
        verdicts_(outside_.size()) {
    std::iota(changed_.begin(), changed_.end(), 0);
  }

  VoteGraph cut() {
    for (;;) {
      std::optional<int> worst = farthest_outside(true);
      if (!worst) worst = least_supported_contractible();
      if (!worst) return graph_.result();
      cut(*worst);
    }
  }

  /// Only what runs outside, and no bridges; none when there is no such link.
  std::optional<VoteGraph> cut_welds() {
    bool is_any = false;
    for (; const auto worst = farthest_outside(false); is_any = true) cut(*worst);
    return is_any ? std::optional(graph_.result()) : std::nullopt;
  }

 private:
  void cut(int link) {
    for (const int l : smooth_.links_beside(link)) forget(l);
    graph_.cut(link);
    smooth_.cut(link);
  }

  std::optional<LineOutside>& outside(int l) { return outside_[static_cast<std::size_t>(l)]; }
  CycleVerdict& verdict(int l) { return verdicts_[static_cast<std::size_t>(l)]; }

  void forget(int changed) {
    outside(changed).reset();
    changed_.push_back(changed);
    for (auto& v : verdicts_)
      if (std::find(v.cycle.begin(), v.cycle.end(), changed) != v.cycle.end()) v.cycle.clear();
  }

  /// The link that runs farthest outside, if any does. What a link may be out by at most puts it in
  /// its place, and only the first is asked for more.
  std::optional<int> farthest_outside(bool bridges_too) {
    place_changed(bridges_too);
    while (!places_.empty()) {
      const int first = places_.begin()->second;
      if (!is_bridge(first) && has_become_bridge(first)) {
        bridge_[static_cast<std::size_t>(first)] = true;
        changed_.push_back(first);
        place_changed(bridges_too);
      } else if (outside(first)->is_known()) {
        return first;
      } else {
        outside(first)->ask(surface_, voxel_);
        place(first);
      }
    }
    return {};
  }

  bool has_become_bridge(int l) const {
    const auto& link = smooth_.link(l);
    return link.a != link.b && smooth_.shortest_way_around(l).empty();
  }

  void place_changed(bool bridges_too) {
    std::vector<int> links;
    for (const int l : std::exchange(changed_, {})) {
      take_out(l);
      if (is_bridge(l) && !bridges_too) continue;
      if (can_be_cut(smooth_.link(l), is_bridge(l))) links.push_back(l);
    }
    sample(links);
    for (const int l : links) place(l);
  }

  void place(int l) {
    take_out(l);
    const double away = outside(l)->at_most() / voxel_;
    const bool is_weak = !is_bridge(l) && smooth_.least_support(l) < kWeakSupport;
    const bool is_hollow = outside(l)->is_known() && away > kHollowVoxels;
    if (away <= (is_weak ? 0 : kGrazingVoxels) || is_hollow) return;
    place_of_[static_cast<std::size_t>(l)] = away;
    places_.insert({-away, l});
  }

  void take_out(int l) {
    auto& away = place_of_[static_cast<std::size_t>(l)];
    if (away) places_.erase({-*away, l});
    away.reset();
  }

  bool is_bridge(int l) const { return bridge_[static_cast<std::size_t>(l)]; }

  bool can_be_cut(const BranchGraph::Link& link, bool is_bridge) const {
    if (!link.alive || smooth_.is_ring(link)) return false;
    return !is_bridge || (smooth_.is_joint(link.a) && smooth_.is_joint(link.b));
  }

  /// Asks the surface along those of these links that are not known, at once.
  void sample(std::vector<int> links) {
    std::erase_if(links, [&](int l) { return outside(l).has_value(); });
    std::vector<Vec3> points;
    std::vector<std::size_t> ends;
    for (const int l : links) {
      const auto line = smooth_.polyline(smooth_.link(l));
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        for (int k = 0; k < kSamplesPerEdge; ++k)
          points.push_back(line[i] + (line[i + 1] - line[i]) * (double(k) / kSamplesPerEdge));
      points.push_back(line.back());
      ends.push_back(points.size());
    }
    const auto sides = surface_.of(points);
    for (std::size_t i = 0, p = 0; i < links.size(); ++i) {
      std::vector<LineSample> samples;
      for (; p < ends[i]; ++p) samples.push_back({points[p], sides[p]});
      outside(links[i]).emplace(samples, kHollowVoxels * voxel_);
    }
  }

  std::optional<int> least_supported_contractible() {
    const auto links = smooth_.links_on_cycles();
    std::vector<int> changed;
    for (const int l : links) {
      auto cycle = smooth_.shortest_cycle(l);
      if (verdict(l).cycle == cycle) continue;
      verdict(l).cycle = std::move(cycle);
      changed.push_back(l);
    }
    ask_for_discs(changed);
    std::vector<int> candidates;
    for (const int l : links)
      if (verdict(l).spans_disc_inside)
        candidates.insert(candidates.end(), verdict(l).cycle.begin(), verdict(l).cycle.end());
    return least_supported(smooth_, candidates);
  }

  /// Asks for the discs of all of these links' cycles at once.
  void ask_for_discs(const std::vector<int>& links) {
    std::vector<Vec3> points;
    std::vector<std::size_t> ends;
    for (const int l : links) {
      const auto disc = disc_of(verdict(l).cycle);
      points.insert(points.end(), disc.begin(), disc.end());
      ends.push_back(points.size());
    }
    const std::vector<PointSide> sides = surface_.of(points);
    std::size_t first = 0;
    for (std::size_t i = 0; i < links.size(); first = ends[i++])
      verdict(links[i]).spans_disc_inside =
          lies_inside(std::span(sides).subspan(first, ends[i] - first));
  }

  /// Points of the cone from the middle of a cycle over it.
  std::vector<Vec3> disc_of(const std::vector<int>& cycle) const {
    std::vector<Vec3> rim;
    for (const int l : cycle) {
      const auto line = smooth_.polyline(smooth_.link(l));
      rim.insert(rim.end(), line.begin(), line.end());
    }
    Vec3 middle;
    for (const auto& p : rim) middle += p / static_cast<double>(rim.size());
    std::vector<Vec3> disc{middle};
    for (const auto& p : rim)
      for (const double s : {0.25, 0.5, 0.75}) disc.push_back(p + (middle - p) * s);
    return disc;
  }

  static bool lies_inside(std::span<const PointSide> disc) {
    double inside = 0, outside = 0;
    for (const auto& s : disc) {
      inside += s.side == Side::Inside;
      outside += s.side == Side::Outside;
    }
    const auto all = static_cast<double>(disc.size());
    return inside >= kInsideShare * all && outside <= kOutsideShare * all;
  }

  BranchGraph graph_, smooth_;
  SurfaceSides& surface_;
  double voxel_;
  std::vector<std::optional<LineOutside>> outside_;  // of every link, where it is known
  std::vector<int> changed_;                         // links that are out of their places
  std::vector<bool> bridge_;  // of every link, as far as it is known: cuts only make more
  std::vector<std::optional<double>> place_of_;
  std::set<std::pair<double, int>> places_;  // of links that may be outside: how far, negated
  std::vector<CycleVerdict> verdicts_;       // of every link's shortest cycle
};

}  // namespace

VoteGraph cut_false_cycles(const VoteGraph& graph, SurfaceSides& surface, double voxel) {
  if (surface.shape().is_point_cloud()) return graph;
  return CycleCheck(graph, surface, voxel).cut();
}

VoteGraph cut_welds(const VoteGraph& graph, SurfaceSides& surface, double voxel) {
  if (surface.shape().is_point_cloud() || BranchGraph(graph).cycle_count() == 0) return graph;
  return CycleCheck(graph, surface, voxel).cut_welds().value_or(graph);
}

VoteGraph cut_surplus_cycles(const VoteGraph& graph, int most_cycles) {
  BranchGraph g(graph);
  // A link on a cycle is no bridge: cutting it leaves one cycle less.
  for (int cycles = g.cycle_count(); cycles > most_cycles; --cycles) {
    const auto least = least_supported(g, g.links_on_cycles());
    if (!least) break;
    g.cut(*least);
  }
  return g.result();
}

}  // namespace marrow
