// Sweeps over a planar graph from left to right and cuts what it winds around into triangles.
// Garey, Johnson, Preparata, Tarjan, "Triangulating a simple polygon", 1978; de Berg et al.,
// "Computational Geometry", chapter 3; where edges meet, as by Shamos and Hoey, 1976.
//
// Between two neighbouring edges on the sweep line lies a region. Where the polygon winds around
// it, it holds a monotone piece that is being cut: a chain. Where two regions have met in a node
// and no edge leaves it to the right, the region holds two chains until its next node, which is
// then joined to that one.

#include <algorithm>
#include <set>
#include <utility>

#include "polygon_detail.hpp"

namespace marrow::polygon_detail {

namespace {

enum class Side { Lower, Upper };

using NodeIndex = std::uint32_t;
using EdgeIndex = std::uint32_t;
using ChainIndex = std::uint32_t;
constexpr std::uint32_t kNone = 0xffffffff;

/// A piece whose nodes come from left to right. The nodes that are still to be joined to a later
/// one run along `side`, but for the first.
struct Chain {
  std::vector<NodeIndex> nodes;
  Side side = Side::Lower;
  int winding = 0;
};

/// Cuts monotone pieces into triangles while their nodes arrive.
class ChainCutter {
 public:
  explicit ChainCutter(const std::vector<Node>& nodes) : nodes_(nodes) {
    triangles_.reserve(nodes.size());
  }

  ChainIndex start(NodeIndex v, int winding) {
    chains_.push_back({{v}, Side::Lower, winding});
    return static_cast<ChainIndex>(chains_.size() - 1);
  }

  /// The chain goes on along `side` to v.
  void add(ChainIndex index, NodeIndex v, Side side) {
    Chain& chain = chains_[index];
    auto& open = chain.nodes;
    if (side == chain.side) {
      while (open.size() > 1 && turns_inwards(open[open.size() - 2], open.back(), v, side)) {
        emit(open[open.size() - 2], open.back(), v, chain.winding);
        open.pop_back();
      }
    } else if (open.size() > 1) {
      join_all(chain, v);
      open = {open.back()};
    }
    open.push_back(v);
    chain.side = side;
  }

  /// Both sides of the chain end in v.
  void close(ChainIndex index, NodeIndex v) {
    join_all(chains_[index], v);
    chains_[index].nodes = {};
  }

  const Chain& chain(ChainIndex index) const { return chains_[index]; }
  std::vector<Triangle> take_triangles() { return std::move(triangles_); }

 private:
  bool turns_inwards(NodeIndex a, NodeIndex b, NodeIndex c, Side side) const {
    const std::int64_t area = doubled_area(nodes_[a], nodes_[b], nodes_[c]);
    return side == Side::Lower ? area > 0 : area < 0;
  }
  void join_all(const Chain& chain, NodeIndex v) {
    for (std::size_t i = 0; i + 1 < chain.nodes.size(); ++i)
      emit(chain.nodes[i], chain.nodes[i + 1], v, chain.winding);
  }
  /// Turned the way the polygon turns.
  void emit(NodeIndex a, NodeIndex b, NodeIndex c, int winding) {
    const std::int64_t area = doubled_area(nodes_[a], nodes_[b], nodes_[c]);
    if (area == 0) return;
    if ((area > 0) != (winding > 0)) std::swap(b, c);
    triangles_.push_back({nodes_[a].id, nodes_[b].id, nodes_[c].id});
  }

  const std::vector<Node>& nodes_;
  std::vector<Chain> chains_;
  std::vector<Triangle> triangles_;
};

/// What lies above an edge, up to the next one.
struct Region {
  int winding = 0;           ///< where it is 0 there are no chains
  ChainIndex chain = kNone;  ///< the only one, or the lower one of two
  ChainIndex upper = kNone;
};

class Sweep {
 public:
  explicit Sweep(const PlaneGraph& graph)
      : nodes_(graph.nodes),
        edges_(graph.edges),
        cutter_(graph.nodes),
        line_(Below{*this}),
        places_(graph.edges.size()),
        regions_(graph.edges.size()),
        left_edge_(graph.nodes.size(), kNone) {
    for (EdgeIndex e = 0; e < edges_.size(); ++e) left_edge_[edges_[e].to] = e;
  }
  Sweep(const Sweep&) = delete;
  Sweep& operator=(const Sweep&) = delete;

  /// False as soon as two edges meet anywhere but in a node.
  bool run() {
    std::vector<EdgeIndex> right;
    EdgeIndex e = 0;
    for (NodeIndex v = 0; v < nodes_.size(); ++v) {
      for (right.clear(); e < edges_.size() && edges_[e].from == v; ++e) right.push_back(e);
      if (!visit(v, right)) return false;
    }
    return true;
  }

  std::vector<Triangle> take_triangles() { return cutter_.take_triangles(); }

 private:
  struct Point {
    NodeIndex node;
  };

  /// The order of edges, and of nodes between them, along the sweep line.
  struct Below {
    using is_transparent = void;  // NOLINT(readability-identifier-naming): what std::set asks for
    const Sweep& sweep;

    bool operator()(EdgeIndex a, EdgeIndex b) const {
      const Edge &e = sweep.edges_[a], &f = sweep.edges_[b];
      if (e.from == f.from) return sweep.height(a, f.to) > 0;
      return e.from < f.from ? sweep.height(a, f.from) > 0 : sweep.height(b, e.from) < 0;
    }
    bool operator()(EdgeIndex e, Point p) const { return sweep.height(e, p.node) > 0; }
    bool operator()(Point p, EdgeIndex e) const { return sweep.height(e, p.node) < 0; }
  };
  using Line = std::set<EdgeIndex, Below>;
  using Place = Line::iterator;

  /// Positive if the node is above the edge, 0 if in line with it.
  std::int64_t height(EdgeIndex e, NodeIndex v) const {
    return doubled_area(nodes_[edges_[e].from], nodes_[edges_[e].to], nodes_[v]);
  }

  /// The edges on the line that end in v, or an empty range at the place of v.
  std::pair<Place, Place> edges_ending_in(NodeIndex v) {
    if (left_edge_[v] == kNone) {
      const Place place = line_.lower_bound(Point{v});
      return {place, place};
    }
    Place first = places_[left_edge_[v]], end = std::next(first);
    while (first != line_.begin() && edges_[*std::prev(first)].to == v) --first;
    while (end != line_.end() && edges_[*end].to == v) ++end;
    return {first, end};
  }

  /// For neighbours on the line: does `lower` stay below `upper` until one of them ends?
  bool stay_apart(EdgeIndex lower, EdgeIndex upper) const {
    const NodeIndex a = edges_[lower].to, b = edges_[upper].to;
    return a == b || (a < b ? height(upper, a) < 0 : height(lower, b) > 0);
  }

  bool visit(NodeIndex v, std::vector<EdgeIndex>& right) {
    const auto [first, end] = edges_ending_in(v);
    const EdgeIndex above = end == line_.end() ? kNone : *end;
    const EdgeIndex below = first == line_.begin() ? kNone : *std::prev(first);
    // On an edge; the search has gone past all edges below v.
    if (above != kNone && height(above, v) >= 0) return false;
    std::sort(right.begin(), right.end(), line_.key_comp());
    if (!stay_apart(below, right, above)) return false;

    const Region over = first == end ? split_below(below, v) : meet(below, first, end, v);
    line_.erase(first, end);
    Region region = below == kNone ? Region{} : regions_[below];
    for (const EdgeIndex e : right) {
      places_[e] = line_.emplace_hint(end, e);
      region = {region.winding + edges_[e].winding, kNone, kNone};
      if (e == right.back())
        region = over;
      else if (region.winding != 0)
        region.chain = cutter_.start(v, region.winding);
      regions_[e] = region;
    }
    // Without an edge between them the regions below and above are one, joined in v.
    if (right.empty() && below != kNone) regions_[below].upper = over.chain;
    return true;
  }

  bool stay_apart(EdgeIndex below, const std::vector<EdgeIndex>& right, EdgeIndex above) const {
    EdgeIndex last = below;
    for (const EdgeIndex e : right) {
      if (last != kNone && !stay_apart(last, e)) return false;
      last = e;
    }
    return last == kNone || above == kNone || stay_apart(last, above);
  }

  /// Nothing ends in v: the region around it is parted by a line to its last node. Leaves the lower
  /// part above `below` and returns the upper one.
  Region split_below(EdgeIndex below, NodeIndex v) {
    if (below == kNone || regions_[below].winding == 0) return {};
    Region& region = regions_[below];
    Region over{region.winding, region.upper, kNone};
    if (region.upper == kNone) {
      const Chain& chain = cutter_.chain(region.chain);
      const NodeIndex last = chain.nodes.back();
      if (chain.side == Side::Lower) {
        over.chain = region.chain;
        region.chain = cutter_.start(last, region.winding);
      } else {
        over.chain = cutter_.start(last, region.winding);
      }
    }
    region.upper = kNone;
    cutter_.add(region.chain, v, Side::Upper);
    cutter_.add(over.chain, v, Side::Lower);
    return over;
  }

  /// Edges end in v: what was between them is closed, what was below and above them goes on to v.
  /// Returns what is above.
  Region meet(EdgeIndex below, Place first, Place end, NodeIndex v) {
    if (below != kNone && regions_[below].winding != 0) {
      Region& region = regions_[below];
      if (region.upper != kNone) cutter_.close(region.upper, v);
      region.upper = kNone;
      cutter_.add(region.chain, v, Side::Upper);
    }
    const Place last = std::prev(end);
    for (Place e = first; e != last; ++e) {
      if (regions_[*e].winding == 0) continue;
      cutter_.close(regions_[*e].chain, v);
      if (regions_[*e].upper != kNone) cutter_.close(regions_[*e].upper, v);
    }
    Region over = regions_[*last];
    if (over.winding == 0) return over;
    if (over.upper != kNone) {
      cutter_.close(over.chain, v);
      over.chain = std::exchange(over.upper, kNone);
    }
    cutter_.add(over.chain, v, Side::Lower);
    return over;
  }

  const std::vector<Node>& nodes_;
  const std::vector<Edge>& edges_;
  ChainCutter cutter_;
  Line line_;
  std::vector<Place> places_;         // of each edge on the line
  std::vector<Region> regions_;       // above each edge
  std::vector<EdgeIndex> left_edge_;  // of each node: one that ends there
};

}  // namespace

std::optional<std::vector<Triangle>> triangulate(const PlaneGraph& graph) {
  Sweep sweep(graph);
  if (!sweep.run()) return {};
  return sweep.take_triangles();
}

}  // namespace marrow::polygon_detail
