#include <algorithm>
#include <bit>

#include "voxel_runs_detail.hpp"

namespace marrow {

namespace {

using Word = VoxelSet::Word;

/// The first x >= `from` whose bit is not `value`, or `end`.
int end_of(const Word* row, int from, int end, bool value) {
  for (int x = from; x < end;) {
    const Word differing = (value ? ~row[x / 64] : row[x / 64]) >> (x % 64);
    if (differing != 0) return std::min(end, x + std::countr_zero(differing));
    x = (x / 64 + 1) * 64;
  }
  return end;
}

}  // namespace

std::vector<VoxelRun> voxel_runs(const VoxelSet& set) {
  std::vector<VoxelRun> runs;
  const int end = static_cast<int>(64 * set.words_per_row());
  for (std::size_t r = 0; r < set.rows(); ++r) {
    const Word* row = set.row(r);
    for (int x = end_of(row, 0, end, false); x < end;) {
      const int run_end = end_of(row, x, end, true);
      runs.push_back({static_cast<std::uint32_t>(r), x, run_end});
      x = end_of(row, run_end, end, false);
    }
  }
  return runs;
}

void erase(VoxelSet& set, const VoxelRun& run) {
  Word* row = set.row(run.row);
  for (int x = run.first; x < run.end;) {
    const int end = std::min(run.end, (x / 64 + 1) * 64);
    const Word ones = end - x == 64 ? ~Word{0} : (Word{1} << (end - x)) - 1;
    row[x / 64] &= ~(ones << (x % 64));
    x = end;
  }
}

}  // namespace marrow
