#include <algorithm>
#include <bit>
#include <cstdint>

#include "volume_rows_detail.hpp"
#include "voxel_moments_detail.hpp"

namespace marrow {

namespace {

__extension__ using Int128 = __int128;

/// Sums of powers 0 to 3 of the places of voxels.
using PowerSums = std::array<std::int64_t, 4>;

/// For every byte, of twice the numbers of its bits.
constexpr std::array<PowerSums, 256> kByteSums = [] {
  std::array<PowerSums, 256> sums{};
  for (std::size_t byte = 0; byte < 256; ++byte)
    for (std::int64_t bit = 0; bit < 8; ++bit) {
      if ((byte >> bit & 1) == 0) continue;
      std::int64_t power = 1;
      for (auto& sum : sums[byte]) sum += power, power *= 2 * bit;
    }
  return sums;
}();

/// Adds the sums of places `from` + what `s` sums.
void add_shifted(PowerSums& total, const PowerSums& s, std::int64_t from) {
  const auto& [n, s1, s2, s3] = s;
  total[0] += n;
  total[1] += n * from + s1;
  total[2] += (n * from + 2 * s1) * from + s2;
  total[3] += ((n * from + 3 * s1) * from + 3 * s2) * from + s3;
}

/// Of the foreground of a row, whose voxel x has the place 2 x - middle.
PowerSums sums_of(volume_detail::Row row, const RowEnds& ends, std::int64_t middle) {
  PowerSums total{};
  for (int x = ends.first & ~7; x <= ends.last; x += 8) {
    const auto byte = row[static_cast<std::size_t>(x) >> 6] >> (x & 63) & 0xff;
    if (byte != 0) add_shifted(total, kByteSums[byte], 2 * x - middle);
  }
  return total;
}

VoxelBox box_of(const std::vector<RowEnds>& rows) {
  VoxelBox box;
  for (const RowEnds& r : rows) {
    const std::array<int, 3> low{r.first, r.y, r.z}, high{r.last, r.y, r.z};
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = box.is_empty ? low[i] : std::min(box.low[i], low[i]);
      box.high[i] = box.is_empty ? high[i] : std::max(box.high[i], high[i]);
    }
    box.is_empty = false;
  }
  return box;
}

/// Sums of x^a y^b z^c over all voxels, a + b + c <= 3.
class RawMoments {
 public:
  void add_row(const PowerSums& x, std::int64_t y, std::int64_t z) {
    std::int64_t power_z = 1;
    for (std::size_t c = 0; c < 4; ++c, power_z *= z) {
      std::int64_t power_yz = power_z;
      for (std::size_t b = 0; b + c < 4; ++b, power_yz *= y)
        for (std::size_t a = 0; a + b + c < 4; ++a) sums_[a][b][c] += Int128{x[a]} * power_yz;
    }
  }

  /// Mean of the product of the coordinates along these axes.
  double mean(std::initializer_list<std::size_t> axes) const {
    std::array<std::size_t, 3> powers{};
    for (const std::size_t i : axes) ++powers[i];
    return static_cast<double>(sums_[powers[0]][powers[1]][powers[2]]) /
           static_cast<double>(sums_[0][0][0]);
  }

 private:
  std::array<std::array<std::array<Int128, 4>, 4>, 4> sums_{};
};

}  // namespace

std::vector<RowEnds> row_ends(const Volume& volume) {
  std::vector<RowEnds> ends;
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y) {
      const volume_detail::Row row = volume.row(y, z);
      std::size_t first = 0, last = row.size();
      while (first < last && row[first] == 0) ++first;
      if (first == last) continue;
      while (row[last - 1] == 0) --last;
      ends.push_back({static_cast<int>(first * 64) + std::countr_zero(row[first]),
                      static_cast<int>(last * 64) - 1 - std::countl_zero(row[last - 1]), y, z});
    }
  return ends;
}

VoxelMoments moments_of(const Volume& volume, const std::vector<RowEnds>& rows) {
  constexpr double kVoxelVariance = 1.0 / 3;  // of a side two long
  VoxelMoments m;
  m.box = box_of(rows);
  RawMoments raw;
  const auto place = [&](std::size_t axis, int voxel) {
    return std::int64_t{2} * voxel - m.box.low[axis] - m.box.high[axis];
  };
  for (const RowEnds& r : rows)
    raw.add_row(sums_of(volume.row(r.y, r.z), r, m.box.low[0] + m.box.high[0]), place(1, r.y),
                place(2, r.z));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double mi = raw.mean({i}), mj = raw.mean({j});
      m.second[i][j] = raw.mean({i, j}) - mi * mj + (i == j ? kVoxelVariance : 0);
      for (std::size_t k = 0; k < 3; ++k) {
        const double mk = raw.mean({k});
        m.third[i][j][k] = raw.mean({i, j, k}) - mi * raw.mean({j, k}) - mj * raw.mean({i, k}) -
                           mk * raw.mean({i, j}) + 2 * mi * mj * mk;
      }
    }
  return m;
}

}  // namespace marrow
