// Every edge waits at its lower end for one that comes from the other side. Few wait at a time, for
// meshes list the triangles around a point soon one after the other.
#include <algorithm>
#include <limits>
#include <utility>

#include "edge_neighbours_detail.hpp"

namespace marrow {

namespace {

using HalfEdge = std::uint32_t;  // 4 times its triangle plus the number of the corner it leaves

constexpr HalfEdge kNone = ~HalfEdge{0};
constexpr std::size_t kMostSteps =
    64;  // for every edge on the average; a hub may have many waiting

class EdgePairing {
 public:
  EdgePairing(std::span<const Triangle> triangles, std::size_t points)
      : triangles_(triangles), waiting_(points, kNone), neighbours_(triangles.size()) {}

  void add(HalfEdge edge) {
    const auto [from, to] = ends(edge);
    if (from == to) {  // it has no other side
      slot(edge) = edge / 4;
      return;
    }
    for (HalfEdge* at = &waiting_[std::min(from, to)];; at = &slot(*at)) {
      if (*at == kNone) {
        *at = edge;
        slot(edge) = kNone;
        ++alone_;
        return;
      }
      ++steps_;
      if (ends(*at) != std::pair(to, from)) continue;
      const HalfEdge other = *at;
      *at = slot(other);
      slot(other) = edge / 4;
      slot(edge) = other / 4;
      --alone_;
      return;
    }
  }

  bool is_complete() const { return alone_ == 0; }
  bool is_too_slow() const { return steps_ > kMostSteps * 3 * triangles_.size(); }
  std::vector<Triangle> neighbours() && { return std::move(neighbours_); }

 private:
  std::pair<std::uint32_t, std::uint32_t> ends(HalfEdge edge) const {
    const Triangle& t = triangles_[edge / 4];
    const std::size_t corner = edge % 4;
    return {t[corner], t[corner == 2 ? 0 : corner + 1]};
  }
  /// Of an edge that waits the next that does; then its neighbour.
  std::uint32_t& slot(HalfEdge edge) { return neighbours_[edge / 4][edge % 4]; }

  std::span<const Triangle> triangles_;
  std::vector<HalfEdge> waiting_;  // the first at every point
  std::vector<Triangle> neighbours_;
  std::size_t alone_ = 0, steps_ = 0;
};

}  // namespace

std::vector<Triangle> edge_neighbours(std::span<const Triangle> triangles, std::size_t points) {
  if (triangles.size() > std::numeric_limits<HalfEdge>::max() / 4) return {};
  EdgePairing pairing(triangles, points);
  for (std::uint32_t t = 0; t < triangles.size() && !pairing.is_too_slow(); ++t)
    for (std::uint32_t corner = 0; corner < 3; ++corner) pairing.add(4 * t + corner);
  return pairing.is_complete() && !pairing.is_too_slow() ? std::move(pairing).neighbours()
                                                         : std::vector<Triangle>();
}

}  // namespace marrow
