#include <marrow/cycle_check.hpp>
#include <marrow/smoothing.hpp>
#include <marrow/surface_sides.hpp>

#include <algorithm>
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

class CycleCheck {
 public:
  // The lines of voxels wiggle and would leave thin limbs here and there: the surface is asked
  // along the smoothed ones, which have the same links.
  CycleCheck(const VoteGraph& graph, const NormalizedShape& shape, double voxel)
      : graph_(graph),
        smooth_(smooth_branches(graph, kSmoothingPasses)),
        shape_(shape),
        voxel_(voxel) {}

  VoteGraph cut(std::optional<int> most_cycles) {
    for (;;) {
      std::optional<int> worst = farthest_outside();
      if (!worst) worst = least_supported_contractible();
      if (!worst && most_cycles && smooth_.cycle_count() > *most_cycles)
        worst = least_supported(smooth_.links_on_cycles());
      if (!worst) return graph_.result();
      graph_.cut(*worst);
      smooth_.cut(*worst);
    }
  }

 private:
  Support support(int link) const {
    return {smooth_.least_support(smooth_.link(link)), smooth_.length(smooth_.link(link))};
  }

  std::optional<int> least_supported(const std::vector<int>& links) const {
    const auto least = std::min_element(links.begin(), links.end(),
                                        [&](int a, int b) { return support(a) < support(b); });
    return least == links.end() ? std::nullopt : std::optional(*least);
  }

  /// The link that runs farthest outside, if any does.
  std::optional<int> farthest_outside() const {
    const auto bridge = smooth_.bridges();
    std::optional<int> worst;
    double farthest = 0;
    for (int l = 0; l < smooth_.link_count(); ++l) {
      const auto& link = smooth_.link(l);
      if (!link.alive || smooth_.is_ring(link)) continue;
      const bool on_cycle = !bridge[static_cast<std::size_t>(l)];
      if (!on_cycle && !(smooth_.is_joint(link.a) && smooth_.is_joint(link.b))) continue;
      const double outside =
          farthest_excursion(samples(link), shape_, voxel_, kHollowVoxels * voxel_);
      const bool weak = on_cycle && smooth_.least_support(link) < kWeakSupport;
      if (outside <= (weak ? 0 : kGrazingVoxels * voxel_) || outside > kHollowVoxels * voxel_)
        continue;
      if (outside > farthest) farthest = outside, worst = l;
    }
    return worst;
  }

  std::vector<Vec3> samples(const BranchGraph::Link& link) const {
    const auto line = smooth_.polyline(link);
    std::vector<Vec3> result;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      for (int k = 0; k < kSamplesPerEdge; ++k)
        result.push_back(line[i] + (line[i + 1] - line[i]) * (double(k) / kSamplesPerEdge));
    result.push_back(line.back());
    return result;
  }

  std::optional<int> least_supported_contractible() const {
    std::vector<int> candidates;
    for (const int l : smooth_.links_on_cycles()) {
      const auto cycle = smooth_.shortest_cycle(l);
      if (spans_disc_inside(cycle)) candidates.insert(candidates.end(), cycle.begin(), cycle.end());
    }
    return least_supported(candidates);
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
    for (const auto& s : sides_of(disc, shape_)) {
      inside += s.side == Side::Inside;
      outside += s.side == Side::Outside;
    }
    const auto all = static_cast<double>(disc.size());
    return inside >= kInsideShare * all && outside <= kOutsideShare * all;
  }

  BranchGraph graph_, smooth_;
  const NormalizedShape& shape_;
  double voxel_;
};

}  // namespace

VoteGraph cut_false_cycles(const VoteGraph& graph, const NormalizedShape& shape, double voxel,
                           std::optional<int> most_cycles) {
  return CycleCheck(graph, shape, voxel).cut(most_cycles);
}

}  // namespace marrow
