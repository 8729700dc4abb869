#include <marrow/weld.hpp>

#include "place_table_detail.hpp"

namespace marrow {

std::vector<std::uint32_t> welded_points(const std::vector<Vec3>& points) {
  PlaceTable places(points.size());
  std::vector<std::uint32_t> first(points.size());
  for (std::uint32_t i = 0; i < first.size(); ++i)
    first[i] = places.number_at(points[i], i, [&](std::uint32_t k) { return points[k]; });
  return first;
}

}  // namespace marrow
