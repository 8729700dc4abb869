#include <marrow/refinement.hpp>

#include <vector>

#include "recentring_detail.hpp"

namespace marrow {

namespace {

constexpr int kRounds = 2;

/// How far points of a line are from each other.
struct Spacing {
  double radii, least, most;  ///< in radii; of the diagonal
};
constexpr Spacing kCoarse{1, 0.004, 0.03}, kFine{0.5, 0.002, 0.03};

void resample(std::vector<BranchLine>& lines, const Spacing& spacing, double diagonal) {
  for (BranchLine& line : lines)
    line = resampled(line, spacing.radii, spacing.least * diagonal, spacing.most * diagonal);
}

}  // namespace

CurveSkeleton recentre(const CurveSkeleton& skeleton, const RefinementInput& input) {
  std::vector<Vec3> places;
  for (const auto& node : skeleton.nodes) places.push_back(node.position);
  const SurfaceProbe probe(input, places);
  std::vector<BranchLine> lines = lines_of(skeleton);
  resample(lines, kCoarse, probe.diagonal());
  recentre(lines, probe, kRounds);
  meet_at_joints(lines, probe);
  resample(lines, kFine, probe.diagonal());  // by radii that are known better now
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
