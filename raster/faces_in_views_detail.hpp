// What the triangles of a surface look like in many images at once.
#pragma once

#include <marrow/silhouette.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace marrow {

inline constexpr std::size_t kMostViews = 64;  // that go together: one bit each

/// A bit for each of the images.
using ViewBits = std::uint64_t;

/// Numbers, each of some of the images, by image.
class ListsByView {
 public:
  void add(ViewBits views, std::uint32_t number) {
    for (; views != 0; views &= views - 1)
      lists_[static_cast<std::size_t>(std::countr_zero(views))].push_back(number);
  }
  std::span<const std::uint32_t> of(std::size_t view) const { return lists_[view]; }

 private:
  std::array<std::vector<std::uint32_t>, kMostViews> lists_;
};

/// The planes of up to kMostViews images, as the kernels want them: lanes past the last are zero.
struct ViewAxes {
  ViewAxes(std::span<const ViewPlane> planes, int resolution);
  /// The bits of all images.
  ViewBits valid() const { return ~ViewBits{0} >> (kMostViews - count); }

  struct Axis {
    alignas(64) std::array<float, kMostViews> x{}, y{}, z{};
  };

  Axis u, v;
  float scale, offset;  // to the lattice
  std::size_t count;
  int resolution;
};

/// What is to be found out of the triangles [first, last) of a shape.
struct FacesTask {
  const NormalizedShape* shape;
  const ViewAxes* axes;
  std::size_t first, last;
  ViewBits* front;    ///< of every triangle: where it runs counter-clockwise
  ListsByView* flat;  ///< triangles without area on the lattice
};

/// Every point is snapped as snap() does it.
void look_at_faces(const FacesTask& task);

/// Some pixels in each image.
class SomePixels {
 public:
  explicit SomePixels(std::span<const BitImage> images);

  bool is_empty() const { return is_empty_; }
  const BitImage& image(std::size_t view) const { return images_[view]; }

  /// On the lattice the box of the pixels in each image: low <= coordinate < high.
  struct Range {
    alignas(64) std::array<std::int32_t, kMostViews> low{}, high{};
  };
  Range x, y;

 private:
  std::span<const BitImage> images_;
  bool is_empty_ = true;
};

/// Adds all of the triangles [first, last) that may have one of the pixels in the box of theirs.
struct PixelsTask {
  const NormalizedShape* shape;
  const ViewAxes* axes;
  const SomePixels* pixels;
  std::size_t first, last;
  ListsByView* found;
};

void look_for_pixels(const PixelsTask& task);

}  // namespace marrow
