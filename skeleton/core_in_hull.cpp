#include <marrow/disjoint_sets.hpp>

#include <algorithm>
#include <optional>
#include <vector>

#include "core_in_hull_detail.hpp"
#include "live_graph_detail.hpp"
#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr int kBridgeSupport = 26;         // of 42 images; real thin limbs have 35 and more
constexpr int kLoneSupport = kImages / 2;  // of a bridge that alone joins two parts

/// A connected piece of the core outside the hull, and how often it meets the hull.
struct OutsideRun {
  std::vector<NodeId> nodes;
  int contacts = 0;
  int support = 0;  // sum

  bool has_support(int images) const { return support >= images * static_cast<int>(nodes.size()); }
  bool is_doubtful_bridge() const { return contacts > 1 && !has_support(kBridgeSupport); }
};

OutsideRun outside_run(const LiveGraph& core, const VoxelSet& hull, NodeId start,
                       std::vector<std::uint8_t>& seen) {
  OutsideRun run{{start}, 0, 0};
  seen[start] = 1;
  for (std::size_t k = 0; k < run.nodes.size(); ++k) {
    run.support += core.node(run.nodes[k]).support;
    for (const NodeId m : core.neighbours(run.nodes[k])) {
      if (hull[core.node(m).voxel])
        ++run.contacts;
      else if (!seen[m])
        seen[m] = 1, run.nodes.push_back(m);
    }
  }
  return run;
}

void add(VoxelSet& hull, const LiveGraph& core, const OutsideRun& run) {
  for (const NodeId n : run.nodes) hull.insert(core.node(n).voxel);
}

/// Which part a voxel lies in, if any.
std::optional<std::uint32_t> part_at(const VoxelGrid& grid, const RunParts& parts,
                                     std::uint32_t voxel) {
  const std::uint32_t row = voxel / static_cast<std::uint32_t>(grid.nx);
  const int x = grid.x_of(voxel);
  const auto found = std::partition_point(
      parts.runs.begin(), parts.runs.end(),
      [&](const VoxelRun& run) { return run.row < row || (run.row == row && run.end <= x); });
  if (found == parts.runs.end() || found->row != row || found->first > x) return {};
  return parts.part[static_cast<std::size_t>(found - parts.runs.begin())];
}

/// Adds the runs that join parts of the hull, the best supported ones first.
void join_parts(const VoxelGrid& grid, VoxelSet& hull, const LiveGraph& core,
                std::vector<OutsideRun> runs) {
  if (runs.empty()) return;
  const auto mean = [](const OutsideRun& run) {
    return static_cast<double>(run.support) / static_cast<double>(run.nodes.size());
  };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const OutsideRun& a, const OutsideRun& b) { return mean(a) > mean(b); });
  const RunParts parts = run_parts(hull);
  DisjointSets joined(parts.count);
  for (const OutsideRun& run : runs) {
    std::optional<std::uint32_t> first;
    bool is_new = false;
    for (const NodeId n : run.nodes)
      for (const NodeId m : core.neighbours(n)) {
        const auto part = part_at(grid, parts, core.node(m).voxel);
        if (part && first) is_new |= joined.join(*first, *part);
        if (part && !first) first = part;
      }
    if (is_new) add(hull, core, run);
  }
}

}  // namespace

void add_core(const VoxelGrid& grid, VoxelSet& hull, const VoteGraph& core, HullOf of) {
  const LiveGraph live(core);
  const VoxelSet before = hull;
  std::vector<std::uint8_t> seen(live.size(), 0);
  std::vector<OutsideRun> doubtful;
  for (NodeId n = 0; n < live.size(); ++n) {
    if (seen[n] || before[live.node(n).voxel]) continue;
    OutsideRun run = outside_run(live, before, n, seen);
    if (!run.is_doubtful_bridge())
      add(hull, live, run);
    else if (of == HullOf::Samples && run.has_support(kLoneSupport))
      doubtful.push_back(std::move(run));
  }
  join_parts(grid, hull, live, std::move(doubtful));
}

}  // namespace marrow
