#include <algorithm>

#include "contour_views_detail.hpp"
#include "fill_detail.hpp"

namespace marrow {

namespace {

constexpr std::size_t kBlock = 1 << 13;  // triangles

}  // namespace

ContourViews::ContourViews(const NormalizedShape& shape, std::span<const Triangle> neighbours,
                           std::span<const ViewPlane> planes, int resolution,
                           const ForEach& for_each)
    : shape_(shape),
      neighbours_(neighbours),
      resolution_(resolution),
      axes_(planes, resolution),
      blocks_((shape.triangles.size() + kBlock - 1) / kBlock) {
  std::vector<ViewBits> front(shape.triangles.size());
  for_each(blocks_.size(), [&](std::size_t i) {
    look_at_faces({&shape_, &axes_, first_of(i), first_of(i + 1), front.data(), &blocks_[i].flat});
  });
  for_each(blocks_.size(), [&](std::size_t i) { find_contours(i, front); });
}

std::size_t ContourViews::first_of(std::size_t block) const {
  return std::min(block * kBlock, shape_.triangles.size());
}

void ContourViews::find_contours(std::size_t block, const std::vector<ViewBits>& front) {
  ListsByView& contours = blocks_[block].contours;
  const std::size_t end = first_of(block + 1);
  for (std::size_t t = first_of(block); t < end; ++t) {
    const Triangle& neighbours = neighbours_[t];
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (const ViewBits views = front[t] & ~front[neighbours[corner]]; views != 0)
        contours.add(views, static_cast<std::uint32_t>(4 * t + corner));
  }
}

std::vector<ContourEdge> ContourViews::contours(std::size_t view,
                                                const SnappedPoints& points) const {
  std::vector<ContourEdge> contours;
  const SnappedPoints::Packed* const packed = points.packed();
  for (const Block& block : blocks_)
    for (const std::uint32_t edge : block.contours.of(view)) {
      const Triangle& t = shape_.triangles[edge / 4];
      const std::size_t corner = edge % 4;
      contours.push_back(
          {unpacked(packed[t[corner]]), unpacked(packed[t[corner == 2 ? 0 : corner + 1]])});
    }
  return contours;
}

PackedTriangles ContourViews::packed(std::size_t view, ListsByView Block::*list,
                                     const SnappedPoints& points) const {
  PackedTriangles result;
  for (const Block& block : blocks_)
    for (const std::uint32_t t : (block.*list).of(view))
      result.push_back(points, shape_.triangles[t]);
  return result;
}

PackedTriangles ContourViews::flat(std::size_t view, const SnappedPoints& points) const {
  return packed(view, &Block::flat, points);
}

void ContourViews::look_for(const SomePixels& pixels, const ForEach& for_each) {
  if (pixels.is_empty()) return;
  for_each(blocks_.size(), [&](std::size_t i) {
    look_for_pixels({&shape_, &axes_, &pixels, first_of(i), first_of(i + 1), &blocks_[i].found});
  });
}

PackedTriangles ContourViews::found(std::size_t view, const SnappedPoints& points) const {
  return packed(view, &Block::found, points);
}

BitImage ContourViews::fill(std::span<const ContourEdge> contours,
                            const PackedTriangles& flat) const {
  BitImage mask = fill_contours(contours, resolution_);
  fill_large(mask, flat, Facing::Both, lattice_shift(resolution_));
  return mask;
}

bool ContourViews::may_have_thin(std::size_t view) const {
  return std::any_of(blocks_.begin(), blocks_.end(), [view](const Block& block) {
    return !block.found.of(view).empty() || !block.flat.of(view).empty();
  });
}

}  // namespace marrow
