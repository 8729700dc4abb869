#include <marrow/disjoint_sets.hpp>

#include <algorithm>
#include <limits>
#include <queue>

#include "branch_graph_detail.hpp"

namespace marrow {

BranchGraph::BranchGraph(const VoteGraph& graph) {
  const auto chains = branches(graph.nodes.size(), graph.edges);
  std::vector<int> vertex_of(graph.nodes.size(), -1);
  const auto vertex_at = [&](NodeId n) {
    if (vertex_of[n] < 0) {
      vertex_of[n] = static_cast<int>(vertices_.size());
      vertices_.push_back({graph.nodes[n], 1, {}});
    }
    return vertex_of[n];
  };
  std::vector<bool> in_chain(graph.nodes.size(), false);
  for (const auto& chain : chains) {
    Link l{vertex_at(chain.nodes.front()), vertex_at(chain.nodes.back()), {}, true};
    for (std::size_t i = 1; i + 1 < chain.nodes.size(); ++i)
      l.inner.push_back(graph.nodes[chain.nodes[i]]);
    for (const NodeId n : chain.nodes) in_chain[n] = true;
    const int id = static_cast<int>(links_.size());
    mutable_vertex(l.a).links.push_back(id);
    mutable_vertex(l.b).links.push_back(id);
    links_.push_back(std::move(l));
  }
  for (NodeId n = 0; n < graph.nodes.size(); ++n)
    if (!in_chain[n]) vertex_at(n);  // a part of one node
}

int BranchGraph::cycle_count() const {
  // Every vertex that is left lies in the part of a root; each link beyond a spanning forest closes
  // one.
  DisjointSets parts(vertices_.size());
  int cycles = 0;
  for (const auto& l : links_)
    if (l.alive && !parts.join(static_cast<std::uint32_t>(l.a), static_cast<std::uint32_t>(l.b)))
      ++cycles;
  return cycles;
}

std::vector<Vec3> BranchGraph::polyline(const Link& link) const {
  std::vector<Vec3> line{at(link.a).node.position};
  for (const auto& n : link.inner) line.push_back(n.position);
  line.push_back(at(link.b).node.position);
  return line;
}

double BranchGraph::length(int l) const {
  const Link& line = link(l);
  if (line.known_length >= 0) return line.known_length;
  double sum = 0;
  const Vec3* previous = &at(line.a).node.position;
  for (const auto& n : line.inner) sum += distance(*previous, n.position), previous = &n.position;
  return line.known_length = sum + distance(*previous, at(line.b).node.position);
}

int BranchGraph::least_support(int l) const {
  const Link& line = link(l);
  if (line.known_support >= 0) return line.known_support;
  int least = kImages;
  for (const auto& n : line.inner) least = std::min(least, n.support);
  if (line.inner.empty()) least = std::min(at(line.a).node.support, at(line.b).node.support);
  return line.known_support = least;
}

std::vector<int> BranchGraph::links_beside(int l) const {
  std::vector<int> links = at(link(l).a).links;
  const auto& more = at(link(l).b).links;
  links.insert(links.end(), more.begin(), more.end());
  return links;
}

void BranchGraph::detach(int l, int v) {
  auto& links = mutable_vertex(v).links;
  links.erase(std::find(links.begin(), links.end(), l));
}

void BranchGraph::cut(int l) {
  const int a = link(l).a, b = link(l).b;
  detach(l, a);
  detach(l, b);
  mutable_link(l).alive = false;
  dissolve(a);
  if (b != a) dissolve(b);
}

/// Joins the two links of a vertex that is neither a leaf nor a joint into one.
void BranchGraph::dissolve(int v) {
  if (degree(v) != 2) return;
  const int first = at(v).links[0], second = at(v).links[1];
  if (first == second) return;  // a ring keeps its vertex
  Link& f = mutable_link(first);
  Link& s = mutable_link(second);
  if (f.b != v) std::swap(f.a, f.b), std::reverse(f.inner.begin(), f.inner.end());
  if (s.a != v) std::swap(s.a, s.b), std::reverse(s.inner.begin(), s.inner.end());
  f.inner.push_back(at(v).node);
  f.inner.insert(f.inner.end(), s.inner.begin(), s.inner.end());
  f.b = s.b;
  forget_measures(f);
  s.alive = false;
  auto& far_links = mutable_vertex(s.b).links;
  *std::find(far_links.begin(), far_links.end(), second) = first;
  mutable_vertex(v).links.clear();
  mutable_vertex(v).merged = 0;
}

void BranchGraph::contract(int l, const VoteGraph::Node& node) {
  const int keep = link(l).a, gone = link(l).b;
  detach(l, keep);
  detach(l, gone);
  mutable_link(l).alive = false;
  for (const int other : at(gone).links) {
    Link& o = mutable_link(other);
    if (o.a == gone) o.a = keep;
    if (o.b == gone) o.b = keep;
    mutable_vertex(keep).links.push_back(other);
  }
  mutable_vertex(keep).node = node;
  for (const int other : at(keep).links) forget_measures(mutable_link(other));
  mutable_vertex(keep).merged += at(gone).merged;
  mutable_vertex(gone).links.clear();
  mutable_vertex(gone).merged = 0;
  dissolve(keep);
}

std::vector<bool> BranchGraph::bridges() const {
  // Tarjan's low points, without recursion: long chains of joints must not exhaust the stack.
  std::vector<bool> bridge(links_.size(), false);
  std::vector<int> order(vertices_.size(), 0), low(vertices_.size(), 0);
  int counter = 0;
  struct Step {
    int vertex, via;
    std::size_t next;
  };
  std::vector<Step> stack;
  for (int root = 0; root < static_cast<int>(vertices_.size()); ++root) {
    if (order[static_cast<std::size_t>(root)] != 0) continue;
    stack.push_back({root, -1, 0});
    order[static_cast<std::size_t>(root)] = low[static_cast<std::size_t>(root)] = ++counter;
    while (!stack.empty()) {
      Step& s = stack.back();
      const auto v = static_cast<std::size_t>(s.vertex);
      if (s.next < vertices_[v].links.size()) {
        const int l = vertices_[v].links[s.next++];
        if (l == s.via || link(l).a == link(l).b) continue;
        const int to = link(l).other(s.vertex);
        const auto t = static_cast<std::size_t>(to);
        if (order[t] != 0) {
          low[v] = std::min(low[v], order[t]);
        } else {
          order[t] = low[t] = ++counter;
          stack.push_back({to, l, 0});
        }
        continue;
      }
      const Step done = s;
      stack.pop_back();
      if (stack.empty()) continue;
      const auto parent = static_cast<std::size_t>(stack.back().vertex);
      low[parent] = std::min(low[parent], low[v]);
      if (low[v] > order[parent]) bridge[static_cast<std::size_t>(done.via)] = true;
    }
  }
  return bridge;
}

std::vector<int> BranchGraph::links_on_cycles() const {
  const auto bridge = bridges();
  std::vector<int> result;
  for (int l = 0; l < link_count(); ++l)
    if (link(l).alive && !bridge[static_cast<std::size_t>(l)] && !is_ring(link(l)))
      result.push_back(l);
  return result;
}

std::vector<int> BranchGraph::shortest_way_around(int l, double limit) const {
  const int from = link(l).a, to = link(l).b;
  std::vector<double> best(vertices_.size(), std::numeric_limits<double>::infinity());
  std::vector<int> via(vertices_.size(), -1);
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
      queue;
  best[static_cast<std::size_t>(from)] = 0;
  queue.push({0, from});
  while (!queue.empty() && from != to) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (v == to || d > limit) break;
    if (d > best[static_cast<std::size_t>(v)]) continue;
    for (const int e : at(v).links) {
      if (e == l) continue;
      const auto n = static_cast<std::size_t>(link(e).other(v));
      const double through = d + length(e);
      if (through >= best[n]) continue;
      best[n] = through;
      via[n] = e;
      queue.push({through, static_cast<int>(n)});
    }
  }
  std::vector<int> way;
  if (best[static_cast<std::size_t>(to)] > limit) return way;
  for (int v = to; via[static_cast<std::size_t>(v)] >= 0 && v != from;
       v = link(way.back()).other(v))
    way.push_back(via[static_cast<std::size_t>(v)]);
  return way;
}

std::vector<int> BranchGraph::shortest_cycle(int l) const {
  std::vector<int> cycle{l};
  const auto way = shortest_way_around(l);
  cycle.insert(cycle.end(), way.begin(), way.end());
  return cycle;
}

VoteGraph BranchGraph::result() const {
  VoteGraph out;
  std::vector<NodeId> id(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].merged == 0) continue;
    id[v] = static_cast<NodeId>(out.nodes.size());
    out.nodes.push_back(vertices_[v].node);
  }
  for (const auto& l : links_) {
    if (!l.alive) continue;
    NodeId previous = id[static_cast<std::size_t>(l.a)];
    for (const auto& n : l.inner) {
      const auto next = static_cast<NodeId>(out.nodes.size());
      out.nodes.push_back(n);
      out.edges.push_back({std::min(previous, next), std::max(previous, next)});
      previous = next;
    }
    const NodeId last = id[static_cast<std::size_t>(l.b)];
    out.edges.push_back({std::min(previous, last), std::max(previous, last)});
  }
  std::sort(out.edges.begin(), out.edges.end());
  out.edges.erase(std::unique(out.edges.begin(), out.edges.end()), out.edges.end());
  std::erase_if(out.edges, [](const CurveSkeleton::Edge& e) { return e[0] == e[1]; });
  return out;
}

}  // namespace marrow
