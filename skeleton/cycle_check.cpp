#include <marrow/cycle_check.hpp>
#include <marrow/smoothing.hpp>
#include <marrow/surface_sides.hpp>

#include <algorithm>
#include <optional>
#include <tuple>

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
    return Support(graph.least_support(graph.link(link)), graph.length(graph.link(link)));
  };
  const auto least = std::min_element(links.begin(), links.end(),
                                      [&](int a, int b) { return support(a) < support(b); });
  return least == links.end() ? std::nullopt : std::optional(*least);
}

class CycleCheck {
 public:
  // The lines of voxels wiggle and would leave thin limbs here and there: the surface is asked
  // along the smoothed ones, which have the same links.
  CycleCheck(const VoteGraph& graph, const NormalizedShape& shape, double voxel)
      : graph_(graph),
        smooth_(smooth_branches(graph, kSmoothingPasses)),
        surface_(shape),
        voxel_(voxel) {}

  VoteGraph cut() {
    for (;;) {
      std::optional<int> worst = farthest_outside();
      if (!worst) worst = least_supported_contractible();
      if (!worst) return graph_.result();
      graph_.cut(*worst);
      smooth_.cut(*worst);
    }
  }

 private:
  /// The link that runs farthest outside, if any does.
  std::optional<int> farthest_outside() const {
    const auto bridge = smooth_.bridges();
    std::vector<int> links;
    for (int l = 0; l < smooth_.link_count(); ++l)
      if (can_be_cut(smooth_.link(l), bridge[static_cast<std::size_t>(l)])) links.push_back(l);
    const auto lines = sample_lines(links);
    std::optional<int> worst;
    double farthest = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const int l = links[i];
      const double outside =
          farthest_excursion(lines[i], surface_, voxel_, kHollowVoxels * voxel_) / voxel_;
      const bool weak = !bridge[static_cast<std::size_t>(l)] &&
                        smooth_.least_support(smooth_.link(l)) < kWeakSupport;
      if (outside <= (weak ? 0 : kGrazingVoxels) || outside > kHollowVoxels) continue;
      if (outside > farthest) farthest = outside, worst = l;
    }
    return worst;
  }

  bool can_be_cut(const BranchGraph::Link& link, bool is_bridge) const {
    if (!link.alive || smooth_.is_ring(link)) return false;
    return !is_bridge || (smooth_.is_joint(link.a) && smooth_.is_joint(link.b));
  }

  /// Samples along all of these links, asked at once.
  std::vector<std::vector<LineSample>> sample_lines(const std::vector<int>& links) const {
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
    std::vector<std::vector<LineSample>> lines(links.size());
    for (std::size_t i = 0, p = 0; i < links.size(); ++i)
      for (; p < ends[i]; ++p) lines[i].push_back({points[p], sides[p]});
    return lines;
  }

  std::optional<int> least_supported_contractible() const {
    std::vector<int> candidates;
    for (const int l : smooth_.links_on_cycles()) {
      const auto cycle = smooth_.shortest_cycle(l);
      if (spans_disc_inside(cycle)) candidates.insert(candidates.end(), cycle.begin(), cycle.end());
    }
    return least_supported(smooth_, candidates);
  }

  /// Whether the cone from the middle of a cycle over it lies inside the shape.
  bool spans_disc_inside(const std::vector<int>& cycle) const {
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
    double inside = 0, outside = 0;
    for (const auto& s : surface_.of(disc)) {
      inside += s.side == Side::Inside;
      outside += s.side == Side::Outside;
    }
    const auto all = static_cast<double>(disc.size());
    return inside >= kInsideShare * all && outside <= kOutsideShare * all;
  }

  BranchGraph graph_, smooth_;
  SurfaceSides surface_;
  double voxel_;
};

}  // namespace

VoteGraph cut_false_cycles(const VoteGraph& graph, const NormalizedShape& shape, double voxel) {
  return CycleCheck(graph, shape, voxel).cut();
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
