#include <marrow/refinement.hpp>

#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastStep = 0.002, kMostStep = 0.03;  // between points, of the diagonal

/// A node that no line leads to.
CurveSkeleton::Node measured(const Vec3& place, const SurfaceProbe& probe) {
  const double radius = probe.radius(place);
  return {place, radius, radius};
}

}  // namespace

CurveSkeleton recentre(const CurveSkeleton& skeleton, const RefinementInput& input) {
  std::vector<Vec3> places;
  for (const auto& node : skeleton.nodes) places.push_back(node.position);
  const SurfaceProbe probe(input, places);
  std::vector<BranchLine> lines = lines_of(skeleton);
  // Steps follow the radius, which is known better after the first round.
  for (const int rounds : {1, 2}) {
    for (BranchLine& line : lines)
      line = resampled(line, kLeastStep * probe.diagonal(), kMostStep * probe.diagonal());
    recentre(lines, probe, rounds);
  }
  for (BranchLine& line : lines) {
    measure(line, probe);
    mend_edges(line, probe);
  }
  settle_tips(lines, probe);
  for (BranchLine& line : lines) measure_sections(line, probe);
  CurveSkeleton result = assemble(skeleton, lines);
  const std::vector<int> degree = degrees(result);
  for (std::size_t n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) result.nodes[n] = measured(result.nodes[n].position, probe);
  return result;
}

}  // namespace marrow
