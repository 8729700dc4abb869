#include <marrow/refinement.hpp>

#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr int kRounds = 2;
constexpr double kLeastStep = 0.002, kMostStep = 0.03;  // between points, of the diagonal

}  // namespace

CurveSkeleton recentre(const CurveSkeleton& skeleton, const RefinementInput& input) {
  std::vector<Vec3> places;
  for (const auto& node : skeleton.nodes) places.push_back(node.position);
  const SurfaceProbe probe(input, places);
  std::vector<BranchLine> lines = lines_of(skeleton);
  const auto resample = [&] {
    for (BranchLine& line : lines)
      line = resampled(line, kLeastStep * probe.diagonal(), kMostStep * probe.diagonal());
  };
  resample();
  recentre(lines, probe, kRounds);
  meet_at_joints(lines, probe);
  resample();  // steps follow the radius, which is known better now
  recentre(lines, probe, kRounds);
  for (BranchLine& line : lines) {
    measure(line, probe);
    mend_edges(line, probe);
  }
  settle_tips(lines, probe);
  for (BranchLine& line : lines) measure_sections(line, probe);
  CurveSkeleton result = assemble(skeleton, lines);
  const std::vector<int> degree = degrees(result);
  for (std::size_t n = 0; n < degree.size(); ++n)
    if (degree[n] == 0)
      result.nodes[n].radius = result.nodes[n].section_radius =
          probe.radius(result.nodes[n].position);
  return result;
}

}  // namespace marrow
