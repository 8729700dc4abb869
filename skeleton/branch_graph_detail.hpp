// A graph seen by its branches: leaves and joints as vertices, chains of nodes as links.
#pragma once

#include <marrow/vote_graph.hpp>

#include <vector>

namespace marrow {

class BranchGraph {
 public:
  struct Vertex {
    VoteGraph::Node node;
    int merged = 1;           ///< joints that this one stands for
    std::vector<int> links;   ///< a loop is listed twice
  };
  struct Link {
    int a = 0, b = 0;                    ///< vertices; equal for a loop
    std::vector<VoteGraph::Node> inner;  ///< from a to b
    bool alive = true;

    int other(int vertex) const { return vertex == a ? b : a; }
  };

  explicit BranchGraph(const VoteGraph& graph);

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Link>& links() const { return links_; }
  int degree(int vertex) const { return static_cast<int>(at(vertex).links.size()); }
  bool is_joint(int vertex) const { return degree(vertex) >= 3; }
  const Vertex& at(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }
  const Link& link(int l) const { return links_[static_cast<std::size_t>(l)]; }

  double length(const Link& link) const;
  /// Least support of the inner nodes; of the ends where there are none.
  int least_support(const Link& link) const;

  /// Takes a link out; an end left with two links is no vertex any more.
  void cut(int link);
  /// Contracts a link between two vertices: its inner nodes go, the ends become one vertex at `node`.
  void contract(int link, const VoteGraph::Node& node);

  /// For every link, whether taking it out would fall a part in two.
  std::vector<bool> bridges() const;
  /// Length of the shortest way from one end of a link to the other without it, if below `limit`;
  /// else `limit`.
  double shortest_way_around(int link, double limit) const;

  VoteGraph result() const;

 private:
  Vertex& mutable_vertex(int v) { return vertices_[static_cast<std::size_t>(v)]; }
  Link& mutable_link(int l) { return links_[static_cast<std::size_t>(l)]; }
  void detach(int link, int vertex);
  void dissolve(int vertex);

  std::vector<Vertex> vertices_;
  std::vector<Link> links_;
};

}  // namespace marrow
