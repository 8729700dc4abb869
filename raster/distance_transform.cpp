#include <marrow/distance_transform.hpp>

#include <algorithm>

namespace marrow {

namespace {

constexpr int kAlong = 3, kDiagonal = 4;

/// One row of the forward or backward pass; `previous` is the row before it in scan order, both
/// padded by one pixel on each side.
void relax_row(int* row, const int* previous, int width, int step) {
  const int first = step > 0 ? 1 : width, end = step > 0 ? width + 1 : 0;
  for (int x = first; x != end; x += step) {
    const int diagonal = std::min(previous[x - 1], previous[x + 1]) + kDiagonal;
    row[x] = std::min({row[x], row[x - step] + kAlong, previous[x] + kAlong, diagonal});
  }
}

}  // namespace

DistanceMap distance_transform(const BitImage& silhouette) {
  const int width = silhouette.width(), height = silhouette.height();
  constexpr int kFar = 1 << 20;
  Image<int> padded(width + 2, height + 2, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) padded(x + 1, y + 1) = silhouette(x, y) ? kFar : 0;
  for (int y = 1; y <= height; ++y) relax_row(padded.row(y), padded.row(y - 1), width, 1);
  for (int y = height; y >= 1; --y) relax_row(padded.row(y), padded.row(y + 1), width, -1);
  DistanceMap map(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map(x, y) = static_cast<ChamferDistance>(padded(x + 1, y + 1));
  return map;
}

}  // namespace marrow
