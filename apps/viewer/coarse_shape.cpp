#include "viewer/coarse_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marrow {

namespace {

constexpr std::uint64_t kSteps = 1 << 16;
constexpr std::uint32_t kNone = ~0U;

using LatticePoint = std::array<std::uint16_t, 3>;

LatticePoint snapped(const Vec3& p) {
  const auto step = [](double c) {
    return static_cast<std::uint16_t>(
        std::clamp(std::floor((c + 1) * 0.5 * (kSteps - 1) + 0.5), 0.0, double{kSteps - 1}));
  };
  return {step(p.x), step(p.y), step(p.z)};
}

/// The cell of every point, numbered in the order of their keys; kNone for points that do not
/// count.
struct Cells {
  std::vector<std::uint32_t> of_point;
  std::uint32_t count = 0;
};

Cells cells_of(std::span<const LatticePoint> points, const std::vector<std::uint8_t>& counts,
               std::uint64_t cells_along) {
  struct Entry {
    std::uint64_t key;
    std::uint32_t point;
  };
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!counts[i]) continue;
    std::uint64_t key = 0;
    for (const std::uint64_t c : points[i]) key = key << 16 | c * cells_along / kSteps;
    entries.push_back({key, i});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key < b.key : a.point < b.point;
  });
  Cells cells{std::vector<std::uint32_t>(points.size(), kNone)};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].key != entries[i - 1].key) ++cells.count;
    cells.of_point[entries[i].point] = cells.count - 1;
  }
  return cells;
}

/// Triangles between cells, each once and by its lowest corner first: which way it faces stays.
std::vector<Triangle> between_cells(std::span<const Triangle> triangles, const Cells& cells) {
  std::vector<Triangle> result;
  for (const Triangle& t : triangles) {
    Triangle c{cells.of_point[t[0]], cells.of_point[t[1]], cells.of_point[t[2]]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    result.push_back(c);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Numbers the cells that triangles use; of a cloud all of them stay.
std::uint32_t leave_out_unused(Cells& cells, std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> number(cells.count, kNone);
  for (const Triangle& t : triangles)
    for (const std::uint32_t c : t) number[c] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t& n : number)
    if (n != kNone) n = count++;
  for (Triangle& t : triangles)
    for (std::uint32_t& c : t) c = number[c];
  for (std::uint32_t& c : cells.of_point)
    if (c != kNone) c = number[c];
  return count;
}

CoarseShape means_of(std::span<const LatticePoint> points, const Cells& cells) {
  struct Sum {
    std::array<std::uint64_t, 3> sum{};
    std::uint64_t count = 0;
    std::uint32_t first = 0;
  };
  std::vector<Sum> sums(cells.count);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (cells.of_point[i] == kNone) continue;
    Sum& s = sums[cells.of_point[i]];
    if (s.count++ == 0) s.first = i;
    for (std::size_t k = 0; k < 3; ++k) s.sum[k] += points[i][k];
  }
  CoarseShape coarse;
  for (const Sum& s : sums) {
    coarse.source.push_back(s.first);
    LatticePoint mean{};
    for (std::size_t k = 0; k < 3; ++k)
      mean[k] = static_cast<std::uint16_t>((s.sum[k] + s.count / 2) / s.count);
    coarse.points.push_back(mean);
  }
  return coarse;
}

}  // namespace

CoarseShape coarsened(std::span<const Vec3> places, std::span<const Triangle> triangles,
                      const PageRoom& room) {
  std::vector<LatticePoint> points;
  points.reserve(places.size());
  for (const Vec3& p : places) points.push_back(snapped(p));
  std::vector<std::uint8_t> counts(points.size(), triangles.empty());
  for (const Triangle& t : triangles)
    for (const std::uint32_t i : t) counts[i] = 1;

  for (std::uint64_t cells_along = kSteps;;) {
    Cells cells = cells_of(points, counts, cells_along);
    std::vector<Triangle> kept = between_cells(triangles, cells);
    if (!triangles.empty()) cells.count = leave_out_unused(cells, kept);
    if (cells.count <= room.points && kept.size() <= room.triangles) {
      CoarseShape coarse = means_of(points, cells);
      for (const auto& [a, b, c] : kept)
        coarse.triangles.push_back({static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                                    static_cast<std::uint16_t>(c)});
      return coarse;
    }
    // A surface has as many cells as the square of those along an axis.
    const double excess =
        std::max(static_cast<double>(cells.count) / static_cast<double>(room.points),
                 static_cast<double>(kept.size()) / static_cast<double>(room.triangles));
    const std::uint64_t from = std::min<std::uint64_t>(cells_along, 1024);
    const auto next = static_cast<std::uint64_t>(static_cast<double>(from) / std::sqrt(excess));
    cells_along = std::max<std::uint64_t>(1, std::min(next, cells_along * 9 / 10));
  }
}

}  // namespace marrow
