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

/// A piece outside the surface, with the last sample before it and the first after it.
struct Excursion {
  std::vector<Vec3> samples;
  double clearance = 0;  // greatest on the way
};

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
    for (int z = z0; z <= z1; ++z)
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
          const auto c = grid.index(x, y, z);
          if (squared_length(grid.center(c) - p) <= reach * reach) near.insert(c);
        }
  }
  return near;
}

/// Cells inside the surface within `reach` of the points.
VoxelSet inside_cells(const VoxelGrid& grid, std::span<const Vec3> points,
                      const SurfaceSides& surface, double reach) {
  VoxelSet inside = cells_near(grid, points, reach);
  std::vector<std::uint32_t> cells;
  std::vector<Vec3> centres;
  inside.for_each([&](std::uint32_t c) {
    cells.push_back(c);
    centres.push_back(grid.center(c));
  });
  const auto sides = surface.of(centres);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (sides[i].side != Side::Inside) inside.erase(cells[i]);
  return inside;
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

/// Whether a way through the cells leads from one end of an excursion to the other. Takes the cells
/// that it visits out.
bool leads_through(const VoxelGrid& grid, VoxelSet& cells, const Vec3& from, const Vec3& to) {
  const auto touches = [&](std::uint32_t c, const Vec3& end) {
    return squared_length(grid.center(c) - end) <= 3 * grid.size * grid.size;
  };
  std::vector<std::uint32_t> visited;
  cells.for_each([&](std::uint32_t c) {
    if (touches(c, from)) visited.push_back(c);
  });
  for (const auto c : visited) cells.erase(c);
  for (std::size_t k = 0; k < visited.size(); ++k) {
    if (touches(visited[k], to)) return true;
    for_neighbours(grid, visited[k], [&](std::uint32_t n) {
      if (cells[n]) cells.erase(n), visited.push_back(n);
    });
  }
  return false;
}

bool has_detour_inside(const Excursion& e, const SurfaceSides& surface, double voxel) {
  const double reach = e.clearance + kDetourVoxels * voxel;
  const VoxelGrid grid = grid_around(e.samples, reach, kDetourCell * voxel);
  VoxelSet inside = inside_cells(grid, e.samples, surface, reach);
  return leads_through(grid, inside, e.samples.front(), e.samples.back());
}

}  // namespace

double farthest_excursion(std::span<const LineSample> samples, const SurfaceSides& surface,
                          double voxel, double hollow) {
  double farthest = 0;
  for (const auto& e : excursions(samples)) {
    if (e.clearance <= farthest) continue;
    if (e.clearance > hollow || !has_detour_inside(e, surface, voxel)) farthest = e.clearance;
  }
  return farthest;
}

}  // namespace marrow
