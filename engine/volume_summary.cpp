#include <marrow/disjoint_sets.hpp>
#include <marrow/volume_summary.hpp>

#include <algorithm>
#include <bit>
#include <vector>

#include "volume_rows_detail.hpp"

namespace marrow {

namespace {

using volume_detail::Row;
using volume_detail::Rows;
using volume_detail::Word;

constexpr std::size_t kMostRuns = std::size_t{1} << 26;

/// Neighbouring voxels of one kind in a row.
struct Run {
  int first, last;
};

/// All runs of foreground, or of background in a box with one more voxel on every side.
class Runs {
 public:
  Runs(const Volume& volume, bool foreground)
      : margin_(foreground ? 0 : 1), ny_(volume.ny + 2 * margin_), nz_(volume.nz + 2 * margin_) {
    const Rows rows(volume);
    for (int z = 0; z < nz_; ++z)
      for (int y = 0; y < ny_; ++y) {
        start_.push_back(runs_.size());
        add_row(rows(y - margin_, z - margin_), foreground, volume.nx);
      }
    start_.push_back(runs_.size());
  }

  /// Runs that touch each other, directly or over others; with `corners` over edges and corners of
  /// voxels too.
  std::size_t parts(bool corners) const {
    DisjointSets sets(runs_.size());
    for (int z = 0; z < nz_; ++z)
      for (int y = 0; y < ny_; ++y) {
        join(sets, y, z, y - 1, z, corners);
        join(sets, y, z, y, z - 1, corners);
        if (!corners) continue;
        join(sets, y, z, y - 1, z - 1, corners);
        join(sets, y, z, y + 1, z - 1, corners);
      }
    return sets.count();
  }

 private:
  void add_row(Row row, bool foreground, int nx) {
    int next = foreground ? 0 : -1;  // where the run that is not foreground begins
    for_each_foreground_run(row, [&](int first, int last) {
      if (foreground)
        runs_.push_back({first, last});
      else if (next < first)
        runs_.push_back({next, first - 1});
      next = last + 1;
    });
    if (!foreground) runs_.push_back({next, nx});
  }

  template <class Visit>
  static void for_each_foreground_run(Row row, const Visit& visit) {
    int first = -1;
    for (std::size_t i = 0; i < row.size(); ++i) {
      // Bits that differ from the one before them: a run begins or has ended.
      Word change = row[i] ^ volume_detail::shifted_up(row, i);
      for (; change != 0; change &= change - 1) {
        const int x = static_cast<int>(i * 64) + std::countr_zero(change);
        if (first >= 0) visit(first, x - 1);
        first = first >= 0 ? -1 : x;
      }
    }
    if (first >= 0) visit(first, static_cast<int>(row.size() * 64) - 1);
  }

  void join(DisjointSets& sets, int y, int z, int other_y, int other_z, bool corners) const {
    if (other_y < 0 || other_y >= ny_ || other_z < 0) return;
    const int reach = corners ? 1 : 0;
    const std::size_t row = index(y, z), other = index(other_y, other_z);
    std::size_t a = start_[row], b = start_[other];
    while (a < start_[row + 1] && b < start_[other + 1]) {
      if (runs_[a].first <= runs_[b].last + reach && runs_[b].first <= runs_[a].last + reach)
        sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
      ++(runs_[a].last < runs_[b].last ? a : b);
    }
  }
  std::size_t index(int y, int z) const {
    return static_cast<std::size_t>(y) +
           static_cast<std::size_t>(ny_) * static_cast<std::size_t>(z);
  }

  int margin_, ny_, nz_;
  std::vector<Run> runs_;
  std::vector<std::size_t> start_;  // of every row
};

std::size_t run_count(const Volume& volume) {
  std::size_t count = 0;
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y) {
      const Row row = volume.row(y, z);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Word begins = row[i] & ~volume_detail::shifted_up(row, i);
        if (begins != 0) count += static_cast<std::size_t>(std::popcount(begins));
      }
    }
  return count;
}

/// Corners - edges + faces - voxels of the union of all foreground voxels: parts - tunnels +
/// cavities (Euler and Poincaré).
std::int64_t euler_number(const Volume& volume) {
  const Rows rows(volume);
  std::int64_t number = 0;
  // Of the four rows around a line of corners along x; bit x stands for what is at the lower end of
  // voxel x, and a further word for the upper end of the last one.
  for (int z = 0; z <= volume.nz; ++z)
    for (int y = 0; y <= volume.ny; ++y) {
      const Row a = rows(y, z), b = rows(y - 1, z), c = rows(y, z - 1), d = rows(y - 1, z - 1);
      Word before_a = 0, before_ab = 0, before_ac = 0, before_all = 0;  // the highest bits
      const auto count = [&](Word wa, Word ab, Word ac, Word all) {
        if ((all | before_all) == 0) return;  // most of a volume is empty
        const Word at_a = wa | wa << 1 | before_a, at_ab = ab | ab << 1 | before_ab,
                   at_ac = ac | ac << 1 | before_ac, at_all = all | all << 1 | before_all;
        before_a = wa >> 63, before_ab = ab >> 63, before_ac = ac >> 63, before_all = all >> 63;
        // Corners; edges along x, z, y; faces across z, y, x; voxels.
        number += std::popcount(at_all) - std::popcount(all) - std::popcount(at_ab) -
                  std::popcount(at_ac) + std::popcount(ab) + std::popcount(ac) +
                  std::popcount(at_a) - std::popcount(wa);
      };
      for (std::size_t i = 0; i < a.size(); ++i)
        count(a[i], a[i] | b[i], a[i] | c[i], a[i] | b[i] | c[i] | d[i]);
      count(0, 0, 0, 0);
    }
  return number;
}

}  // namespace

std::size_t foreground_count(const Volume& volume) {
  std::size_t count = 0;
  for (const Word w : volume.bits) count += static_cast<std::size_t>(std::popcount(w));
  return count;
}

Bounds foreground_bounds(const Volume& volume) {
  Bounds bounds;
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y) {
      const Row row = volume.row(y, z);
      const auto is_set = [](Word w) { return w != 0; };
      const auto first = std::find_if(row.begin(), row.end(), is_set);
      if (first == row.end()) continue;
      const auto last = std::find_if(row.rbegin(), row.rend(), is_set);
      const auto low = (first - row.begin()) * 64 + std::countr_zero(*first);
      const auto high = (row.rend() - last) * 64 - 1 - std::countl_zero(*last);
      for (const double x : {static_cast<double>(low) - 0.5, static_cast<double>(high) + 0.5})
        for (const double dy : {-0.5, 0.5})
          for (const double dz : {-0.5, 0.5}) bounds.add(volume.to_world({x, y + dy, z + dz}));
    }
  return bounds;
}

std::optional<VolumeTopology> topology_of(const Volume& volume) {
  const auto rows = static_cast<std::size_t>(volume.ny) * static_cast<std::size_t>(volume.nz);
  if (run_count(volume) + rows > kMostRuns) return {};
  VolumeTopology topology;
  topology.components = Runs(volume, true).parts(true);
  topology.cavities = Runs(volume, false).parts(false) - 1;
  topology.tunnels =
      static_cast<std::size_t>(static_cast<std::int64_t>(topology.components) +
                               static_cast<std::int64_t>(topology.cavities) - euler_number(volume));
  return topology;
}

}  // namespace marrow
