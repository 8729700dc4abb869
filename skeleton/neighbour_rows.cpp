#include <utility>

#include "neighbour_rows_detail.hpp"

namespace marrow::skeleton_detail {

void NeighbourRows::add(std::int64_t id, const CurveSkeleton::Node& node, std::size_t line) {
  ids_.add(id, line);
  skeleton_.nodes.push_back(node);
}

void NeighbourRows::add_neighbour(std::int64_t id, std::size_t line) {
  links_.push_back({static_cast<NodeId>(skeleton_.nodes.size() - 1), id, line});
}

CurveSkeleton NeighbourRows::finish(const Source& source) && {
  ids_.sort(source);
  for (const Link& link : links_) {
    const NodeId to = ids_.find(link.to, "neighbour", link.line, source);
    if (to == link.from) fail(source.name, link.line, "an edge from a node to itself");
    skeleton_.edges.push_back({link.from, to});
  }
  tidy_edges(skeleton_);
  return std::move(skeleton_);
}

}  // namespace marrow::skeleton_detail
