#include <marrow/disjoint_sets.hpp>
#include <marrow/nearest_sample.hpp>
#include <marrow/touching_bodies.hpp>
#include <marrow/voxel_set.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include "branch_graph_detail.hpp"
#include "live_graph_detail.hpp"

namespace marrow {

namespace {

// In spacings: where they lie on the surface, samples are nearer than half of one to most
// places of it.
constexpr double kOffSurface = 1;
constexpr double kAtSurface = 0.5;
constexpr double kInside = 0.6;
constexpr int kPlacesPerEdge = 4;
constexpr std::size_t kLeastWelds = 2;

/// Calls visit(voxel) for the voxels with their centres within `radius` of a place.
template <class Visit>
void for_voxels_near(const VoxelGrid& grid, const Vec3& place, double radius, Visit visit) {
  const Vec3 at = (place - grid.origin) / grid.size;
  const int x = static_cast<int>(at.x), y = static_cast<int>(at.y), z = static_cast<int>(at.z);
  const int reach = static_cast<int>(radius / grid.size) + 1;
  for (int dz = -reach; dz <= reach; ++dz)
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        if (!grid.contains(x + dx, y + dy, z + dz)) continue;
        if (squared_length(grid.center(x + dx, y + dy, z + dz) - place) <= radius * radius)
          visit(grid.index(x + dx, y + dy, z + dz));
      }
}

VoxelSet voxels_at_samples(const VoxelGrid& grid, const NormalizedShape& cloud) {
  VoxelSet near(grid);
  for (std::size_t i = 0; i < cloud.spacing.size(); ++i) {
    if (!(cloud.spacing[i] > 0)) continue;
    const Vec3 sample{double{cloud.x[i]}, double{cloud.y[i]}, double{cloud.z[i]}};
    for_voxels_near(grid, sample, kOffSurface * double{cloud.spacing[i]},
                    [&](std::uint32_t v) { near.insert(v); });
  }
  return near;
}

std::vector<Vec3> places_along(const std::vector<Vec3>& line) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    for (int k = 0; k < kPlacesPerEdge; ++k)
      places.push_back(line[i] + (line[i + 1] - line[i]) * (double(k) / kPlacesPerEdge));
  places.push_back(line.back());
  return places;
}

/// Whether a line is inside, at the surface and inside again.
bool passes_through(const std::vector<Vec3>& line, const NormalizedShape& cloud) {
  const std::vector<double> depths = sample_depths(cloud, places_along(line));
  const auto least = std::min_element(depths.begin(), depths.end());
  const double before = *std::max_element(depths.begin(), least + 1);
  const double behind = *std::max_element(least, depths.end());
  return *least < kAtSurface && std::min(before, behind) >= kInside;
}

bool is_between_joints(const BranchGraph& graph, const BranchGraph::Link& link) {
  return link.a != link.b && graph.is_joint(link.a) && graph.is_joint(link.b);
}

/// What is left of a graph without some of its links.
class Bodies {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  Bodies(const BranchGraph& graph, const std::vector<bool>& without) : sets_(vertex_count(graph)) {
    for (int l = 0; l < graph.link_count(); ++l)
      if (!without[static_cast<std::size_t>(l)])
        sets_.join(number(graph.link(l).a), number(graph.link(l).b));
  }

  /// The bodies that a link joins, the lesser number first.
  Pair joined_by(const BranchGraph::Link& link) {
    return std::minmax({sets_.root(number(link.a)), sets_.root(number(link.b))});
  }

 private:
  static std::uint32_t number(int vertex) { return static_cast<std::uint32_t>(vertex); }
  static std::size_t vertex_count(const BranchGraph& graph) {
    int last = -1;
    for (int l = 0; l < graph.link_count(); ++l)
      last = std::max({last, graph.link(l).a, graph.link(l).b});
    return static_cast<std::size_t>(last + 1);
  }

  DisjointSets sets_;
};

}  // namespace

VoteGrid votes_off_samples(VoteGrid votes, const NormalizedShape& cloud) {
  const VoxelSet near = voxels_at_samples(votes.grid, cloud);
  std::erase_if(votes.votes, [&](const Vote& v) { return near[v.voxel]; });
  return votes;
}

std::optional<VoteGraph> part_bodies(const VoteGraph& graph, const NormalizedShape& cloud) {
  BranchGraph g(graph);
  std::vector<bool> is_weld(static_cast<std::size_t>(g.link_count()), false);
  std::vector<int> welds;
  for (int l = 0; l < g.link_count(); ++l) {
    if (!is_between_joints(g, g.link(l)) || !passes_through(g.polyline(g.link(l)), cloud)) continue;
    is_weld[static_cast<std::size_t>(l)] = true;
    welds.push_back(l);
  }
  Bodies bodies(g, is_weld);
  std::map<Bodies::Pair, std::vector<int>> between;
  for (const int l : welds) {
    const Bodies::Pair pair = bodies.joined_by(g.link(l));
    if (pair.first != pair.second) between[pair].push_back(l);
  }
  bool is_any = false;
  for (const auto& [pair, links] : between) {
    if (links.size() < kLeastWelds) continue;
    for (const int l : links)
      if (g.link(l).alive) g.cut(l), is_any = true;
  }
  return is_any ? std::optional(g.result()) : std::nullopt;
}

VoteGraph without_lone_nodes(const VoteGraph& graph) {
  if (graph.edges.empty()) return graph;
  LiveGraph live(graph);
  for (NodeId n = 0; n < live.size(); ++n)
    if (live.degree(n) == 0) live.remove_node(n);
  return live.result();
}

}  // namespace marrow
