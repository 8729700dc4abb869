// The balls of a graph's nodes by place: which of them may hold a point.
#pragma once

#include <marrow/vote_graph.hpp>

#include <vector>

namespace marrow {

/// Balls of about one size are sorted by their middles into cells as wide as they are: those that
/// hold a point lie in eight cells. There are such cells for every power of two of sizes.
class BallGrid {
 public:
  /// Sizes below `least_radius` are not told apart.
  BallGrid(const VoteGraph& graph, double least_radius);

  /// Where a search for the balls around one point is; it begins when it is made.
  struct Search {
    std::uint32_t cells_seen = 0;
    NodeId next = kNone;
  };

  /// The next node whose ball may hold `p`, or kNone. Every node comes once at most, those whose
  /// balls hold `p` all come.
  NodeId next(const Vec3& p, Search& search) const;

  static constexpr NodeId kNone = ~NodeId{0};

 private:
  struct Cell {
    std::uint64_t key = kNoKey;
    NodeId first = kNone;
  };
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

  std::size_t find(std::uint64_t key) const;

  std::vector<double> sizes_;  // edges of cells; of sizes that occur
  std::vector<Cell> cells_;    // a hash table
  std::vector<NodeId> after_;  // the next node in the cell of a node
};

}  // namespace marrow
