// Makes the graph of a polygon planar: splits its edges where they cross or touch.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "polygon_detail.hpp"

namespace marrow::polygon_detail {

namespace {

constexpr std::size_t kMaxCrossings = 150'000;

/// A node on the inside of an edge.
struct Split {
  std::uint32_t edge;
  std::uint32_t node;
};

struct Box {
  std::int64_t min_x, max_x, min_y, max_y;
};

Box box_of(const PlaneGraph& graph, const Edge& edge) {
  const Node &a = graph.nodes[edge.from], &b = graph.nodes[edge.to];
  return {a.x, b.x, std::min(a.y, b.y), std::max(a.y, b.y)};
}

bool overlap(const Box& a, const Box& b) {
  return a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y;
}

class Splitter {
 public:
  Splitter(PlaneGraph& graph, std::vector<Vec3>& points) : graph_(graph), points_(points) {}

  /// Finds where the two edges, whose boxes overlap, meet in other places than shared nodes.
  void meet(std::uint32_t a, std::uint32_t b) {
    const Edge e = graph_.edges[a], f = graph_.edges[b];
    const auto side = [&](const Edge& edge, std::uint32_t node) {
      const auto& nodes = graph_.nodes;
      return doubled_area(nodes[edge.from], nodes[edge.to], nodes[node]);
    };
    const std::int64_t e_from = side(f, e.from), e_to = side(f, e.to);
    const std::int64_t f_from = side(e, f.from), f_to = side(e, f.to);
    if (e_from == 0) touch(b, e.from);
    if (e_to == 0) touch(b, e.to);
    if (f_from == 0) touch(a, f.from);
    if (f_to == 0) touch(a, f.to);
    const auto apart = [](std::int64_t p, std::int64_t q) {
      return (p < 0 && q > 0) || (p > 0 && q < 0);
    };
    if (apart(e_from, e_to) && apart(f_from, f_to))
      cross(a, b, part(e_from, e_to), part(f_from, f_to));
  }

  std::size_t split_count() const { return splits_.size(); }

  /// Replaces every split edge by its pieces.
  void apply() {
    std::sort(splits_.begin(), splits_.end(), [&](const Split& s, const Split& t) {
      if (s.edge != t.edge) return s.edge < t.edge;
      const std::int64_t a = progress(s), b = progress(t);
      return a != b ? a < b : s.node < t.node;
    });
    for (std::size_t i = 0; i < splits_.size();) {
      const std::uint32_t index = splits_[i].edge;
      const Edge edge = graph_.edges[index];
      std::uint32_t last = edge.from;
      for (; i < splits_.size() && splits_[i].edge == index; ++i) {
        graph_.edges.push_back({last, splits_[i].node, edge.winding});
        last = splits_[i].node;
      }
      graph_.edges[index] = {last, edge.to, edge.winding};
    }
    tidy(graph_);
  }

 private:
  /// How far along its edge a split lies.
  std::int64_t progress(const Split& s) const {
    const Edge& edge = graph_.edges[s.edge];
    const Node &a = graph_.nodes[edge.from], &b = graph_.nodes[edge.to], &p = graph_.nodes[s.node];
    return (b.x - a.x) * (p.x - a.x) + (b.y - a.y) * (p.y - a.y);
  }

  /// `node` is in line with the edge: is it on its inside?
  void touch(std::uint32_t edge, std::uint32_t node) {
    const Edge& e = graph_.edges[edge];
    // Nodes are in order of x, then y, and so are all places along an edge.
    if (e.from < node && node < e.to) splits_.push_back({edge, node});
  }

  /// Where between two places of opposite height the height is zero, from 0 to 1.
  static double part(std::int64_t from, std::int64_t to) {
    return static_cast<double>(from) / (static_cast<double>(from) - static_cast<double>(to));
  }

  /// A new node where the edges cross: `s` along the first, `t` along the second. In space the
  /// edges may pass each other, and the new point is half way between them.
  void cross(std::uint32_t a, std::uint32_t b, double s, double t) {
    const Node from = graph_.nodes[graph_.edges[a].from], to = graph_.nodes[graph_.edges[a].to];
    const auto along = [s](std::int64_t p, std::int64_t q) {
      return p + static_cast<std::int64_t>(std::floor(static_cast<double>(q - p) * s + 0.5));
    };
    const auto node = static_cast<std::uint32_t>(graph_.nodes.size());
    graph_.nodes.push_back(
        {along(from.x, to.x), along(from.y, to.y), static_cast<std::uint32_t>(points_.size())});
    points_.push_back(place(a, s) * 0.5 + place(b, t) * 0.5);
    splits_.push_back({a, node});
    splits_.push_back({b, node});
  }

  Vec3 place(std::uint32_t edge, double t) const {
    const Edge& e = graph_.edges[edge];
    return points_[graph_.nodes[e.from].id] * (1 - t) + points_[graph_.nodes[e.to].id] * t;
  }

  PlaneGraph& graph_;
  std::vector<Vec3>& points_;
  std::vector<Split> splits_;
};

/// Boxes in order of x, or of y if the edges are shorter that way.
std::vector<std::uint32_t> sweep_order(std::vector<Box>& boxes) {
  double width = 0, height = 0;
  for (const Box& b : boxes) {
    width += static_cast<double>(b.max_x - b.min_x);
    height += static_cast<double>(b.max_y - b.min_y);
  }
  if (height < width)
    for (Box& b : boxes) b = {b.min_y, b.max_y, b.min_x, b.max_x};
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return boxes[a].min_x < boxes[b].min_x; });
  return order;
}

/// Brings the nodes in order, one for each place.
void merge_nodes(PlaneGraph& graph) {
  auto& nodes = graph.nodes;
  std::vector<std::uint32_t> order(nodes.size()), rank(nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) { return std::pair(nodes[i].x, nodes[i].y); };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return place(a) < place(b); });
  std::vector<Node> sorted;
  sorted.reserve(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || place(order[i]) != place(order[i - 1])) sorted.push_back(nodes[order[i]]);
    rank[order[i]] = static_cast<std::uint32_t>(sorted.size() - 1);
  }
  nodes = std::move(sorted);
  for (Edge& e : graph.edges) e = {rank[e.from], rank[e.to], e.winding};
}

/// Brings the edges in order, one between any two nodes; those without a winding go.
void merge_edges(PlaneGraph& graph) {
  auto& edges = graph.edges;
  for (Edge& e : edges)
    if (e.from > e.to) e = {e.to, e.from, -e.winding};
  const auto ends = [](const Edge& e) { return std::pair(e.from, e.to); };
  std::sort(edges.begin(), edges.end(),
            [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size();) {
    Edge e = edges[i];
    for (++i; i < edges.size() && ends(edges[i]) == ends(e); ++i) e.winding += edges[i].winding;
    if (e.winding != 0 && e.from != e.to) edges[kept++] = e;
  }
  edges.resize(kept);
}

/// A node whose edges have cancelled must not get in the way of others.
void drop_unused_nodes(PlaneGraph& graph) {
  std::vector<std::uint32_t> rank(graph.nodes.size(), 0);
  for (const Edge& e : graph.edges) rank[e.from] = rank[e.to] = 1;
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < rank.size(); ++i) {
    if (rank[i] == 0) continue;
    graph.nodes[kept] = graph.nodes[i];
    rank[i] = kept++;
  }
  graph.nodes.resize(kept);
  for (Edge& e : graph.edges) e = {rank[e.from], rank[e.to], e.winding};
}

}  // namespace

void tidy(PlaneGraph& graph) {
  merge_nodes(graph);
  merge_edges(graph);
  drop_unused_nodes(graph);
}

bool split_crossings(PlaneGraph& graph, std::vector<Vec3>& points, std::int64_t& budget) {
  std::vector<Box> boxes;
  boxes.reserve(graph.edges.size());
  for (const Edge& e : graph.edges) boxes.push_back(box_of(graph, e));
  const auto order = sweep_order(boxes);
  Splitter splitter(graph, points);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Box& box = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min_x <= box.max_x; ++j) {
      if (--budget < 0) return false;
      if (overlap(box, boxes[order[j]])) splitter.meet(order[i], order[j]);
    }
    if (splitter.split_count() > 2 * kMaxCrossings) return false;
  }
  splitter.apply();
  return true;
}

}  // namespace marrow::polygon_detail
