// Nodes in rows that list their neighbours, as .skel and .csv have them.
#pragma once

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

/// Collects the rows; ids may have gaps and name rows that are yet to come.
class NeighbourRows {
 public:
  void reserve(std::size_t rows) { skeleton_.nodes.reserve(rows); }
  void add(std::int64_t id, const CurveSkeleton::Node& node, std::size_t line);
  /// The last row has the node with this id for a neighbour.
  void add_neighbour(std::int64_t id, std::size_t line);
  /// Throws Error: Malformed (an id given twice, one that no row has, an edge to itself).
  CurveSkeleton finish(const Source& source) &&;

 private:
  struct Link {
    NodeId from;
    std::int64_t to;
    std::size_t line;
  };

  CurveSkeleton skeleton_;
  NodeIds ids_;
  std::vector<Link> links_;
};

}  // namespace marrow::skeleton_detail
