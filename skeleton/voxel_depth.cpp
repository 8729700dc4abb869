// The (3,4,5) chamfer transform in two passes over the runs of the set; only two layers are open.
#include <marrow/homotopic_thinning.hpp>

#include <algorithm>
#include <array>

#include "voxel_runs_detail.hpp"

namespace marrow {

namespace {

using Depth = std::int16_t;  // signed: every machine has a least of vectors of these

constexpr Depth kFace = 3, kEdge = 4, kCorner = 5;

/// target[i] = the least over the 3x3 voxels of the layer before and the three of the row before.
void relax(Depth* target, const Depth* row, const std::array<const Depth*, 3>& layer, int n) {
  const Depth *a = layer[0], *b = layer[1], *c = layer[2];
  for (int i = 0; i < n; ++i) {
    const Depth face = std::min(b[i], row[i]);
    const Depth edge = std::min({a[i], c[i], b[i - 1], b[i + 1], row[i - 1], row[i + 1]});
    const Depth corner = std::min({a[i - 1], a[i + 1], c[i - 1], c[i + 1]});
    target[i] = static_cast<Depth>(std::min({face + kFace, edge + kEdge, corner + kCorner}));
  }
}

/// The open layers of a pass, padded by a voxel on each side.
class Layers {
 public:
  explicit Layers(const VoxelGrid& grid)
      : width_(static_cast<std::size_t>(grid.nx) + 2),
        before_(width_ * (static_cast<std::size_t>(grid.ny) + 2), 0),
        here_(before_.size(), 0) {}

  void next() {
    before_.swap(here_);
    std::fill(here_.begin(), here_.end(), Depth{0});
  }

  Depth* row(int y) { return here_.data() + offset(y); }

  /// The least over the voxels that come before run [x, x + n) of row y, when rows come in the
  /// direction `step`.
  void relax_run(int y, int x, int n, int step) {
    const Depth* layer = before_.data() + x;
    relax(row(y) + x, row(y - step) + x,
          {layer + offset(y - 1), layer + offset(y), layer + offset(y + 1)}, n);
  }

 private:
  std::size_t offset(int y) const { return static_cast<std::size_t>(y + 1) * width_ + 1; }

  std::size_t width_;
  std::vector<Depth> before_, here_;
};

}  // namespace

std::vector<ChamferDistance> distance_transform(const VoxelGrid& grid, const VoxelSet& set) {
  const std::vector<VoxelRun> runs = voxel_runs(set);
  std::vector<ChamferDistance> depth(count(set));
  Layers forward(grid);
  auto out = depth.begin();
  int z = 0;
  for (const VoxelRun& run : runs) {
    const int y = static_cast<int>(run.row) % grid.ny;
    for (; z < static_cast<int>(run.row) / grid.ny; ++z) forward.next();
    forward.relax_run(y, run.first, run.size(), 1);
    Depth* d = forward.row(y);
    for (int x = run.first; x < run.end; ++x) {
      d[x] = std::min(d[x], static_cast<Depth>(d[x - 1] + kFace));
      *out++ = static_cast<ChamferDistance>(d[x]);
    }
  }
  Layers backward(grid);
  z = grid.nz - 1;
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    const int y = static_cast<int>(run->row) % grid.ny;
    for (; z > static_cast<int>(run->row) / grid.ny; --z) backward.next();
    backward.relax_run(y, run->first, run->size(), -1);
    Depth* d = backward.row(y);
    for (int x = run->end; x-- > run->first;) {
      --out;
      d[x] = std::min({d[x], static_cast<Depth>(d[x + 1] + kFace), static_cast<Depth>(*out)});
      *out = static_cast<ChamferDistance>(d[x]);
    }
  }
  return depth;
}

}  // namespace marrow
