// The .polylines.txt files of CGAL: `k x1 y1 z1 ... xk yk zk`, without radii.
#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "skeleton_text_detail.hpp"

namespace marrow::skeleton_detail {

namespace {

constexpr NodeId kNone = std::numeric_limits<NodeId>::max();

/// Nodes by their places: what lies at one place is one node.
class Places {
 public:
  NodeId node_at(const Vec3& p, double radius, CurveSkeleton& skeleton) {
    const auto id = static_cast<NodeId>(skeleton.nodes.size());
    const auto [place, is_new] = ids_.try_emplace({p.x, p.y, p.z}, id);
    if (is_new) skeleton.nodes.push_back({p, radius});
    return place->second;
  }

 private:
  std::map<std::array<double, 3>, NodeId> ids_;
};

void read_polyline(const Lines& lines, double radius, Places& places, CurveSkeleton& skeleton) {
  const std::uint64_t count = lines.count(0);
  const std::size_t numbers = lines.words().size() - 1;
  if (count == 0 || numbers % 3 != 0 || count != numbers / 3)
    lines.fail("the line claims " + std::to_string(count) + " points and has " +
               std::to_string(numbers) + " numbers");
  NodeId last = kNone;
  for (std::size_t i = 1; i < numbers; i += 3) {
    const NodeId node = places.node_at({lines.number(i), lines.number(i + 1), lines.number(i + 2)},
                                       radius, skeleton);
    if (last != kNone && last != node) skeleton.edges.push_back({last, node});
    last = node;
  }
}

void append_polyline(std::string& text, const CurveSkeleton& skeleton,
                     const std::vector<NodeId>& nodes) {
  append(text, std::uint64_t{nodes.size()});
  for (const NodeId n : nodes) {
    const Vec3& p = skeleton.nodes[n].position;
    for (const double value : {p.x, p.y, p.z}) {
      text += ' ';
      append(text, value);
    }
  }
  text += '\n';
}

}  // namespace

std::string format_polylines(const CurveSkeleton& skeleton) {
  std::string text;
  for (const Branch& branch : branches(skeleton)) append_polyline(text, skeleton, branch.nodes);
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < degree.size(); ++n)
    if (degree[n] == 0) append_polyline(text, skeleton, {n});
  return text;
}

CurveSkeleton parse_polylines(std::string_view bytes, const Source& source) {
  CurveSkeleton skeleton;
  Places places;
  for (Lines lines(bytes, source); lines.next();) {
    double radius = 0;
    const std::string fault = check_radius(radius, false, source);
    if (!fault.empty()) lines.fail(fault);
    read_polyline(lines, radius, places, skeleton);
  }
  tidy_edges(skeleton);
  return skeleton;
}

}  // namespace marrow::skeleton_detail
