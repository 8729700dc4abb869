#include <marrow/bounds.hpp>
#include <marrow/visual_hull.hpp>

#include <algorithm>
#include <utility>

#include "excursion_detail.hpp"
#include "voxel_parts_detail.hpp"

namespace marrow {

namespace {

constexpr double kDetourVoxels = 1;  // how far beyond the excursion's clearance a detour may run
constexpr double kDetourCell = 0.5;  // voxels: gaps between limbs are found down to this

std::vector<Excursion> excursions(std::span<const LineSample> samples) {
  const auto outside = [&](std::size_t i) { return samples[i].surface.side == Side::Outside; };
  std::vector<Excursion> result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!outside(i)) continue;
    Excursion e;
    if (i > 0) e.samples.push_back(samples[i - 1].position);
    for (; i < samples.size() && outside(i); ++i) {
      e.samples.push_back(samples[i].position);
      e.clearance = std::max(e.clearance, samples[i].surface.clearance);
    }
    if (i < samples.size()) e.samples.push_back(samples[i].position);
    result.push_back(std::move(e));
  }
  return result;
}

VoxelGrid grid_around(std::span<const Vec3> points, double reach, double cell) {
  Bounds box;
  for (const auto& p : points) box.add(p);
  const auto cells = [&](double extent) {
    return static_cast<int>((extent + 2 * reach) / cell) + 3;
  };
  const Vec3 extent = box.high - box.low;
  return {box.low - Vec3{1, 1, 1} * (reach + cell), cell, cells(extent.x), cells(extent.y),
          cells(extent.z)};
}

/// Cells with their centre within `reach` of one of the points.
VoxelSet cells_near(const VoxelGrid& grid, std::span<const Vec3> points, double reach) {
  VoxelSet near(grid);
  const auto range = [&](double coordinate, int cells) {
    const auto cell = [&](double at) {
      return std::clamp(static_cast<int>(at / grid.size), 0, cells - 1);
    };
    return std::pair(cell(coordinate - reach - grid.size), cell(coordinate + reach + grid.size));
  };
  for (const auto& p : points) {
    const Vec3 at = p - grid.origin;
    const auto [x0, x1] = range(at.x, grid.nx);
    const auto [y0, y1] = range(at.y, grid.ny);
    const auto [z0, z1] = range(at.z, grid.nz);
    for (int z = z0; z <= z1; ++z) {
      for (int y = y0; y <= y1; ++y) {
        const auto is_far = [&](int x) {
          return squared_length(grid.center(x, y, z) - p) > reach * reach;
        };
        int first = x0, last = x1;
        while (first <= last && is_far(first)) ++first;
        while (last > first && is_far(last)) --last;
        VoxelSet::Word* row = near.row(static_cast<std::size_t>(y + grid.ny * z));
        for (int x = first; x <= last; ++x) row[x / 64] |= VoxelSet::Word{1} << (x % 64);
      }
    }
  }
  return near;
}

/// Leaves those of the cells that lie inside the surface.
void keep_inside(const VoxelGrid& grid, std::vector<std::uint32_t>& cells, SurfaceSides& surface) {
  std::vector<Vec3> centres;
  for (const auto c : cells) centres.push_back(grid.center(c));
  const auto sides = surface.of(centres);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (sides[i].side == Side::Inside) cells[kept++] = cells[i];
  cells.resize(kept);
}

/// Calls visit(index) for the 26 neighbours of a cell that lie in the grid.
template <class Visit>
void for_neighbours(const VoxelGrid& g, std::uint32_t cell, Visit visit) {
  const int x = g.x_of(cell), y = g.y_of(cell), z = g.z_of(cell);
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if ((dx != 0 || dy != 0 || dz != 0) && g.contains(x + dx, y + dy, z + dz))
          visit(g.index(x + dx, y + dy, z + dz));
}

/// Whether a way through the cells that lie inside the surface leads from one end of an excursion
/// to the other. Takes the cells that it comes to out, and asks the surface of no others.
bool leads_through(const VoxelGrid& grid, VoxelSet& cells, SurfaceSides& surface, const Vec3& from,
                   const Vec3& to) {
  const auto touches = [&](std::uint32_t c, const Vec3& end) {
    return squared_length(grid.center(c) - end) <= 3 * grid.size * grid.size;
  };
  std::vector<std::uint32_t> reached;
  cells.for_each([&](std::uint32_t c) {
    if (touches(c, from)) reached.push_back(c);
  });
  for (const auto c : reached) cells.erase(c);
  while (!reached.empty()) {
    keep_inside(grid, reached, surface);
    std::vector<std::uint32_t> next;
    for (const auto c : reached) {
      if (touches(c, to)) return true;
      for_neighbours(grid, c, [&](std::uint32_t n) {
        if (cells[n]) cells.erase(n), next.push_back(n);
      });
    }
    reached = std::move(next);
  }
  return false;
}

bool has_detour_inside(const Excursion& e, SurfaceSides& surface, double voxel) {
  const double reach = e.clearance + kDetourVoxels * voxel;
  const VoxelGrid grid = grid_around(e.samples, reach, kDetourCell * voxel);
  VoxelSet near = cells_near(grid, e.samples, reach);
  return leads_through(grid, near, surface, e.samples.front(), e.samples.back());
}

}  // namespace

LineOutside::LineOutside(std::span<const LineSample> samples, double hollow)
    : pieces_(excursions(samples)), hollow_(hollow) {
  std::stable_sort(pieces_.begin(), pieces_.end(), [](const Excursion& a, const Excursion& b) {
    return a.clearance < b.clearance;
  });
  counts_ = at_most() > hollow_;
}

void LineOutside::ask(SurfaceSides& surface, double voxel) {
  if (is_known()) return;
  counts_ = !has_detour_inside(pieces_.back(), surface, voxel);
  if (!counts_) pieces_.pop_back();
}

}  // namespace marrow
