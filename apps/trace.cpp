#include "trace.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "picture/png.hpp"
#include "picture/stage_images.hpp"

namespace marrow {

namespace {

std::string sheet_of(const std::vector<LabelledImage>& images) {
  return encode_png(contact_sheet(images));
}

/// `draw` of both images of every pair, on one sheet.
template <class Draw>
std::string view_sheet(const std::vector<StereoImages>& views, Draw draw) {
  std::vector<LabelledImage> images;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    images.push_back({number + " front", draw(views[i].front)});
    images.push_back({number + " side", draw(views[i].side)});
  }
  return sheet_of(images);
}

RgbImage draw_mask(const ViewImage& view) {
  const BitImage& mask = view.silhouette;
  return to_rgb(bit_mask_image(mask.words(), mask.width(), mask.height()));
}

RgbImage draw_distance(const ViewImage& view) {
  return heat_image(view.distance.pixels(), view.distance.width(), view.distance.height());
}

RgbImage draw_axis(const ViewImage& view) {
  std::vector<AxisPixel> pixels;
  for (int y = 0; y < view.axis.rows(); ++y)
    for (const MedialPixel& p : view.axis.row(y)) pixels.push_back({p.x, y, p.distance});
  const BitImage& mask = view.silhouette;
  return axis_image(mask.words(), mask.width(), mask.height(), pixels);
}

/// The whole grid along its three axes, then slabs along z, the shape's least extent; empty slabs
/// are left out.
std::string grid_sheet(const VoxelGrid& grid, const std::vector<GridCell>& cells,
                       Brightness brightness) {
  constexpr int kSlabs = 21;
  std::vector<LabelledImage> images;
  const auto add = [&](std::string label, GridAxis axis, int first, int last) {
    const GridSlab slab{grid.nx, grid.ny, grid.nz, axis, first, last};
    images.push_back({std::move(label), slab_image(cells, slab, brightness)});
  };
  add("all along x", GridAxis::X, 0, grid.nx);
  add("all along y", GridAxis::Y, 0, grid.ny);
  add("all along z", GridAxis::Z, 0, grid.nz);
  const int step = std::max(1, (grid.nz + kSlabs - 1) / kSlabs);
  for (int first = 0; first < grid.nz; first += step) {
    const int last = std::min(first + step, grid.nz);
    const auto inside = [&](const GridCell& cell) { return cell.z >= first && cell.z < last; };
    if (std::none_of(cells.begin(), cells.end(), inside)) continue;
    const std::string end = last - first > 1 ? " to " + std::to_string(last - 1) : "";
    add("z " + std::to_string(first) + end, GridAxis::Z, first, last);
  }
  return sheet_of(images);
}

GridCell cell_of(const VoxelGrid& grid, std::uint32_t voxel, std::uint32_t amount) {
  return {grid.x_of(voxel), grid.y_of(voxel), grid.z_of(voxel), amount};
}

std::string vote_sheet(const VoteGrid& votes) {
  std::vector<GridCell> cells;
  for (const Vote& v : votes.votes) cells.push_back(cell_of(votes.grid, v.voxel, v.count));
  return grid_sheet(votes.grid, cells, Brightness::Root);
}

std::string support_sheet(const VoteGrid& votes) {
  std::vector<GridCell> cells;
  for (const Vote& v : votes.votes) cells.push_back(cell_of(votes.grid, v.voxel, v.support));
  return grid_sheet(votes.grid, cells, Brightness::Linear);
}

std::string solid_sheet(const VoxelGrid& grid, const VoxelSet& solid) {
  std::vector<GridCell> cells;
  solid.for_each([&](std::uint32_t voxel) { cells.push_back(cell_of(grid, voxel, 1)); });
  return grid_sheet(grid, cells, Brightness::Linear);
}

}  // namespace

std::vector<OutputFile> draw_trace(const ExtractTrace& t, const std::string& folder) {
  std::vector<OutputFile> files;
  const auto add = [&](const char* name, std::string bytes) {
    char number[8];
    std::snprintf(number, sizeof number, "%02zu_", files.size() + 1);
    files.push_back({folder + "/" + number + name, std::move(bytes)});
  };
  const auto add_graph = [&](const char* name, const VoteGraph& graph) {
    add(name, format_skeleton(to_input_units(graph, t.normalization), SkeletonFormat::Obj));
  };
  add("silhouettes.png", view_sheet(t.views, draw_mask));
  add("distances.png", view_sheet(t.views, draw_distance));
  add("medial_axes.png", view_sheet(t.views, draw_axis));
  add("votes.png", vote_sheet(t.votes));
  add("support.png", support_sheet(t.cleaned));
  add_graph("tree.obj", t.tree);
  add_graph("core.obj", t.core);
  const bool by_paper = t.thinned.nodes.empty();
  if (!by_paper) add("solid.png", solid_sheet(t.votes.grid, t.solid));
  if (!by_paper) add_graph("thinned.obj", t.thinned);
  add_graph("collapsed.obj", t.collapsed);
  if (by_paper) add_graph("looped.obj", t.looped);
  add_graph("smoothed.obj", t.smoothed);
  add("refined.obj",
      format_skeleton(to_input_units(t.refined, t.normalization), SkeletonFormat::Obj));
  add("skeleton.obj", format_skeleton(t.skeleton, SkeletonFormat::Obj));
  return files;
}

}  // namespace marrow
