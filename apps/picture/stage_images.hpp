// The stages of an extraction as images, for a person to see where a limb was lost (--trace).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "picture/image.hpp"

namespace marrow {

/// How amounts become brightness. Root lifts small amounts, as among votes, where few voxels hold
/// most.
enum class Brightness { Linear, Root };

/// A pixel of a medial axis.
struct AxisPixel {
  int x = 0, y = 0;
  std::uint16_t distance = 0;
};

/// A voxel that is not empty.
struct GridCell {
  int x = 0, y = 0, z = 0;
  std::uint32_t amount = 0;
};

enum class GridAxis { X, Y, Z };

/// A layer of voxels, or of more than one: `first` <= place along `axis` < `last`.
struct GridSlab {
  int nx = 0, ny = 0, nz = 0;  ///< voxels of the grid
  GridAxis axis = GridAxis::Z;
  int first = 0, last = 1;
};

struct LabelledImage {
  std::string label;
  RgbImage image;
};

// Images are row by row, `width` x `height`; amounts are scaled so that the greatest is brightest.
// All throw Error: Internal, when a span does not hold that many values.

/// White where `mask` is not 0.
GreyImage mask_image(std::span<const std::uint8_t> mask, int width, int height);

/// The same from one bit per pixel: bit x % 64 of word x / 64 of a row, rows of whole words.
GreyImage bit_mask_image(std::span<const std::uint64_t> words, int width, int height);

/// Amounts as grey on black.
GreyImage grey_image(std::span<const std::uint16_t> amounts, int width, int height);

/// Amounts as heat on black.
RgbImage heat_image(std::span<const std::uint16_t> amounts, int width, int height,
                    Brightness brightness = Brightness::Linear);
RgbImage heat_image(std::span<const std::uint32_t> amounts, int width, int height,
                    Brightness brightness = Brightness::Linear);

/// A medial axis coloured by distance, thin amber to thick violet, over its pale silhouette, which
/// is given as for bit_mask_image(). Pixels outside the image are left out.
RgbImage axis_image(std::span<const std::uint64_t> silhouette, int width, int height,
                    std::span<const AxisPixel> axis);

/// The greatest amounts across a slab as heat. Across and upwards the image shows y and z for axis
/// X, x and z for Y, x and y for Z. Cells outside the slab are left out.
RgbImage slab_image(std::span<const GridCell> cells, const GridSlab& slab,
                    Brightness brightness = Brightness::Root);

RgbImage to_rgb(const GreyImage& image);

/// All images on one sheet in rows of `columns` (0: about square), each under its label.
/// Throws Error: Internal, when there are none.
RgbImage contact_sheet(std::span<const LabelledImage> images, int columns = 0);

}  // namespace marrow
