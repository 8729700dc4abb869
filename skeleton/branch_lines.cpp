#include <algorithm>
#include <cmath>

#include "branch_lines_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kMostEdges = 20'000;  // of a line

BranchLine line_of(const CurveSkeleton& skeleton, const Branch& branch,
                   const std::vector<int>& degree) {
  BranchLine line;
  line.start = branch.nodes.front();
  line.end = branch.nodes.back();
  line.is_ring = branch.is_closed() && degree[line.start] == 2;
  line.starts_at_leaf = degree[line.start] == 1;
  line.ends_at_leaf = degree[line.end] == 1;
  line.least_edges = branch.is_closed() ? 3 : std::min<std::size_t>(branch.nodes.size() - 1, 2);
  for (const NodeId n : branch.nodes) {
    const auto& node = skeleton.nodes[n];
    line.points.push_back(
        {.position = node.position, .radius = node.radius, .section_radius = node.section_radius});
  }
  if (line.is_ring) line.points.pop_back();
  return line;
}

/// The point at a share of the way from `a` to `b`.
LinePoint between(const LinePoint& a, const LinePoint& b, double share) {
  const auto mix = [share](double x, double y) { return x * (1 - share) + y * share; };
  const double way = distance(a.position, b.position);
  return {a.position * (1 - share) + b.position * share, mix(a.radius, b.radius),
          mix(a.section_radius, b.section_radius),
          std::min(a.most + way * share, b.most + way * (1 - share))};
}

}  // namespace

std::vector<BranchLine> lines_of(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton);
  std::vector<BranchLine> lines;
  for (const Branch& branch : branches(skeleton))
    lines.push_back(line_of(skeleton, branch, degree));
  return lines;
}

BranchLine resampled(const BranchLine& line, double radii, double least, double most) {
  const auto step = [&](std::size_t i) {
    return std::clamp(radii * line.points[i].radius, least, most);
  };
  std::vector<double> steps_before{0};  // how many steps lead to each point; to the first again
  for (std::size_t e = 0; e < line.edge_count(); ++e)
    steps_before.push_back(steps_before.back() +
                           2 * line.edge_length(e) / (step(e) + step(line.after(e))));
  const auto wanted = static_cast<std::size_t>(
      std::min(std::ceil(steps_before.back()), static_cast<double>(kMostEdges)));
  const std::size_t edges = std::max(wanted, line.least_edges);
  BranchLine result = line;
  result.points.assign(1, line.points.front());
  std::size_t e = 0;
  for (std::size_t i = 1; i < edges; ++i) {
    const double at = steps_before.back() * static_cast<double>(i) / static_cast<double>(edges);
    while (e + 1 < line.edge_count() && steps_before[e + 1] < at) ++e;
    const double span = steps_before[e + 1] - steps_before[e];
    const double share = span > 0 ? std::clamp((at - steps_before[e]) / span, 0.0, 1.0) : 0;
    result.points.push_back(between(line.points[e], line.points[line.after(e)], share));
  }
  if (!line.is_ring) result.points.push_back(line.points.back());
  return result;
}

Vec3 place_along(const BranchLine& line, std::size_t i, double reach, bool forwards) {
  double left = reach;
  for (std::size_t steps = 0; steps < line.size(); ++steps) {
    const bool at_end = !line.is_ring && (forwards ? i + 1 == line.size() : i == 0);
    if (at_end) break;
    const std::size_t next = forwards ? line.after(i) : line.before(i);
    const Vec3 &a = line.points[i].position, &b = line.points[next].position;
    const double edge = distance(a, b);
    if (edge >= left) return edge > 0 ? a + (b - a) * (left / edge) : a;
    left -= edge;
    i = next;
  }
  return line.points[i].position;
}

Vec3 heading_at(const BranchLine& line, std::size_t i, double reach) {
  const Vec3 way = line.points[i].position - place_along(line, i, reach, false);
  const double long_way = length(way);
  return long_way > 0 ? way / long_way : Vec3{};
}

Vec3 tangent_at(const BranchLine& line, std::size_t i, double reach) {
  const Vec3 chord = place_along(line, i, reach, true) - place_along(line, i, reach, false);
  const double long_enough = length(chord);
  return long_enough > 0 ? chord / long_enough : Vec3{};
}

CurveSkeleton assemble(const CurveSkeleton& skeleton, const std::vector<BranchLine>& lines) {
  constexpr NodeId kNone = ~NodeId{0};
  CurveSkeleton result;
  const auto add = [&](const LinePoint& p) {
    result.nodes.push_back({p.position, p.radius, p.section_radius});
    return static_cast<NodeId>(result.nodes.size() - 1);
  };
  std::vector<NodeId> id(skeleton.nodes.size(), kNone);
  const std::vector<int> degree = degrees(skeleton);
  for (NodeId n = 0; n < id.size(); ++n)
    if (degree[n] == 0) {
      id[n] = static_cast<NodeId>(result.nodes.size());
      result.nodes.push_back(skeleton.nodes[n]);
    }
  const auto end_of = [&](NodeId n, const LinePoint& p) {
    if (id[n] == kNone) id[n] = add(p);
    return id[n];
  };
  for (const BranchLine& line : lines) {
    NodeId last = end_of(line.start, line.points.front());
    const auto connect = [&](NodeId next) {
      result.edges.push_back({std::min(last, next), std::max(last, next)});
      last = next;
    };
    for (std::size_t i = 1; i < line.size(); ++i) {
      const bool is_end = !line.is_ring && i + 1 == line.size();
      connect(is_end ? end_of(line.end, line.points[i]) : add(line.points[i]));
    }
    if (line.is_ring) connect(id[line.start]);
  }
  std::sort(result.edges.begin(), result.edges.end());
  return result;
}

}  // namespace marrow
