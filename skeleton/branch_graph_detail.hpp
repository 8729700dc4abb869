// A graph seen by its branches: leaves and joints as vertices, chains of nodes as links.
#pragma once

#include <marrow/vote_graph.hpp>

#include <limits>
#include <vector>

namespace marrow {

class BranchGraph {
 public:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  struct Vertex {
    VoteGraph::Node node;
    int merged = 1;          ///< joints that this one stands for
    std::vector<int> links;  ///< a loop is listed twice
  };
  struct Link {
    int a = 0, b = 0;                    ///< vertices; equal for a loop
    std::vector<VoteGraph::Node> inner;  ///< from a to b
    bool alive = true;
    mutable double known_length = -1;  ///< negative where it is not known
    mutable int known_support = -1;

    int other(int vertex) const { return vertex == a ? b : a; }
  };

  explicit BranchGraph(const VoteGraph& graph);

  int link_count() const { return static_cast<int>(links_.size()); }  ///< cut ones included
  int degree(int vertex) const { return static_cast<int>(at(vertex).links.size()); }
  bool is_joint(int vertex) const { return degree(vertex) >= 3; }
  const Vertex& at(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }
  const Link& link(int l) const { return links_[static_cast<std::size_t>(l)]; }

  /// A part that is one loop, without a joint.
  bool is_ring(const Link& link) const { return link.a == link.b && degree(link.a) == 2; }
  /// Independent cycles.
  int cycle_count() const;

  /// Positions along a link, both ends included.
  std::vector<Vec3> polyline(const Link& link) const;
  double length(int link) const;
  /// Least support of the inner nodes; of the ends where there are none.
  int least_support(int link) const;
  /// All links at the two ends of a link, itself included: those that cut() and contract() change.
  std::vector<int> links_beside(int link) const;

  /// Takes a link out; an end left with two links is no vertex any more.
  void cut(int link);
  /// Contracts a link between two vertices: its inner nodes go, the ends become one vertex at
  /// `node`.
  void contract(int link, const VoteGraph::Node& node);

  /// For every link, whether taking it out would fall a part in two.
  std::vector<bool> bridges() const;
  /// Links that are no bridges, without parts that are rings: one can be cut and leave its part
  /// whole.
  std::vector<int> links_on_cycles() const;
  /// The links of the shortest way from one end of a link to the other without it; empty for a loop
  /// and for a bridge, and where there is none shorter than `limit` or not much longer.
  std::vector<int> shortest_way_around(int link, double limit = kNoLimit) const;
  /// The shortest cycle through a link, the link first.
  std::vector<int> shortest_cycle(int link) const;

  VoteGraph result() const;

 private:
  Vertex& mutable_vertex(int v) { return vertices_[static_cast<std::size_t>(v)]; }
  Link& mutable_link(int l) { return links_[static_cast<std::size_t>(l)]; }
  static void forget_measures(Link& link) { link.known_length = -1, link.known_support = -1; }
  void detach(int link, int vertex);
  void dissolve(int vertex);

  std::vector<Vertex> vertices_;
  std::vector<Link> links_;
};

}  // namespace marrow
