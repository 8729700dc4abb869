#include <marrow/refinement.hpp>

#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr double kLeastStep = 0.002, kMostStep = 0.03;  // between points, of the diagonal

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
  for (BranchLine& line : lines) mend_edges(line, probe);
  settle_tips(lines, probe);
  for (BranchLine& line : lines) measure_sections(line, probe);
  CurveSkeleton result = assemble(skeleton, lines);
  for (auto& node : result.nodes)
    if (node.section_radius < node.radius) node.section_radius = node.radius;
  return result;
}

}  // namespace marrow
