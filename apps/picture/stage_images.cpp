#include "picture/stage_images.hpp"

#include <marrow/error.hpp>

#include <algorithm>
#include <cmath>

#include "picture/colour_map.hpp"
#include "picture/font.hpp"

namespace marrow {
namespace {

constexpr Colour kPaper = {1, 1, 1};
constexpr Colour kSilhouette = from_bytes(214, 222, 231);
constexpr Colour kText = from_bytes(40, 44, 52);

std::size_t area_of(int width, int height) {
  return static_cast<std::size_t>(std::max(width, 0)) *
         static_cast<std::size_t>(std::max(height, 0));
}

void check_size(std::size_t given, std::size_t expected) {
  if (given != expected) {
    throw Error(ErrorKind::Internal, "trace: the values of a stage do not fill its image");
  }
}

std::size_t words_per_row(int width) { return static_cast<std::size_t>((width + 63) / 64); }

bool bit_of(std::span<const std::uint64_t> words, int width, int x, int y) {
  const auto word =
      static_cast<std::size_t>(y) * words_per_row(width) + static_cast<std::size_t>(x / 64);
  return (words[word] >> (x % 64) & 1) != 0;
}

/// Place of an amount between 0 and the greatest of all.
template <class T>
class Scale {
 public:
  Scale(std::span<const T> amounts, Brightness brightness) : brightness_(brightness) {
    for (const T amount : amounts) greatest_ = std::max(greatest_, amount);
  }
  float operator()(T amount) const {
    if (greatest_ == 0) return 0;
    const float part = static_cast<float>(amount) / static_cast<float>(greatest_);
    return brightness_ == Brightness::Root ? std::sqrt(part) : part;
  }

 private:
  T greatest_ = 0;
  Brightness brightness_;
};

void append(std::vector<std::uint8_t>& pixels, const Colour& colour) {
  for (const float channel : {colour.r, colour.g, colour.b}) pixels.push_back(to_byte(channel));
}

template <class T>
RgbImage heat(std::span<const T> amounts, int width, int height, Brightness brightness) {
  check_size(amounts.size(), area_of(width, height));
  const Scale<T> place(amounts, brightness);
  RgbImage image{width, height, {}};
  image.pixels.reserve(3 * amounts.size());
  for (const T amount : amounts) append(image.pixels, heat_colour(place(amount)));
  return image;
}

/// Columns, rows and layers of a grid as a slab shows them.
struct SlabView {
  int width, height, across, up, layer;
};

SlabView seen(const GridSlab& slab, const GridCell& cell) {
  switch (slab.axis) {
    case GridAxis::X:
      return {slab.ny, slab.nz, cell.y, cell.z, cell.x};
    case GridAxis::Y:
      return {slab.nx, slab.nz, cell.x, cell.z, cell.y};
    default:
      return {slab.nx, slab.ny, cell.x, cell.y, cell.z};
  }
}

void paste(Canvas& canvas, int left, int top, const RgbImage& image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t i =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
               static_cast<std::size_t>(x));
      canvas.blend(left + x, top + y,
                   from_bytes(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]), 1);
    }
  }
}

/// As much of the label as fits.
std::string fitting(const std::string& label, int width, float dot) {
  std::string text = label;
  while (!text.empty() && text_width(text, dot) > static_cast<float>(width)) text.pop_back();
  return text;
}

}  // namespace

GreyImage mask_image(std::span<const std::uint8_t> mask, int width, int height) {
  check_size(mask.size(), area_of(width, height));
  GreyImage image{width, height, {}};
  image.pixels.reserve(mask.size());
  for (const std::uint8_t value : mask) image.pixels.push_back(value != 0 ? 255 : 0);
  return image;
}

GreyImage bit_mask_image(std::span<const std::uint64_t> words, int width, int height) {
  check_size(words.size(), words_per_row(width) * static_cast<std::size_t>(height));
  GreyImage image{width, height, {}};
  image.pixels.reserve(area_of(width, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.pixels.push_back(bit_of(words, width, x, y) ? 255 : 0);
  }
  return image;
}

GreyImage grey_image(std::span<const std::uint16_t> amounts, int width, int height) {
  check_size(amounts.size(), area_of(width, height));
  const Scale<std::uint16_t> place(amounts, Brightness::Linear);
  GreyImage image{width, height, {}};
  image.pixels.reserve(amounts.size());
  for (const std::uint16_t amount : amounts) image.pixels.push_back(to_byte(place(amount)));
  return image;
}

RgbImage heat_image(std::span<const std::uint16_t> amounts, int width, int height,
                    Brightness brightness) {
  return heat(amounts, width, height, brightness);
}

RgbImage heat_image(std::span<const std::uint32_t> amounts, int width, int height,
                    Brightness brightness) {
  return heat(amounts, width, height, brightness);
}

RgbImage axis_image(std::span<const std::uint64_t> silhouette, int width, int height,
                    std::span<const AxisPixel> axis) {
  check_size(silhouette.size(), words_per_row(width) * static_cast<std::size_t>(height));
  Canvas canvas(width, height, kPaper);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (bit_of(silhouette, width, x, y)) canvas.at(x, y) = kSilhouette;
    }
  }
  std::uint16_t greatest = 1;
  for (const AxisPixel& pixel : axis) greatest = std::max(greatest, pixel.distance);
  for (const AxisPixel& pixel : axis) {
    const float place = static_cast<float>(pixel.distance) / static_cast<float>(greatest);
    canvas.blend(pixel.x, pixel.y, radius_colour(place), 1);
  }
  return to_image(canvas);
}

RgbImage slab_image(std::span<const GridCell> cells, const GridSlab& slab, Brightness brightness) {
  const SlabView size = seen(slab, {});
  std::vector<std::uint32_t> amounts(area_of(size.width, size.height), 0);
  for (const GridCell& cell : cells) {
    const SlabView at = seen(slab, cell);
    if (at.layer < slab.first || at.layer >= slab.last) continue;
    if (at.across < 0 || at.up < 0 || at.across >= size.width || at.up >= size.height) continue;
    const auto row = static_cast<std::size_t>(size.height - 1 - at.up);
    std::uint32_t& amount =
        amounts[row * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(at.across)];
    amount = std::max(amount, cell.amount);
  }
  return heat_image(std::span<const std::uint32_t>(amounts), size.width, size.height, brightness);
}

RgbImage to_rgb(const GreyImage& image) {
  RgbImage rgb{image.width, image.height, {}};
  rgb.pixels.reserve(3 * image.pixels.size());
  for (const std::uint8_t value : image.pixels) rgb.pixels.insert(rgb.pixels.end(), 3, value);
  return rgb;
}

RgbImage contact_sheet(std::span<const LabelledImage> images, int columns) {
  if (images.empty()) throw Error(ErrorKind::Internal, "trace: a contact sheet without images");
  int width = 1;
  int height = 1;
  for (const LabelledImage& each : images) {
    check_size(each.image.pixels.size(), 3 * area_of(each.image.width, each.image.height));
    width = std::max(width, each.image.width);
    height = std::max(height, each.image.height);
  }
  const auto count = static_cast<int>(images.size());
  if (columns <= 0) columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  columns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  const float dot = std::max(1.0F, static_cast<float>(width) / 160.0F);
  const int gap = std::max(4, width / 40);
  const int caption = static_cast<int>(text_height(dot) + 2 * dot);
  Canvas canvas(gap + columns * (width + gap), gap + rows * (height + caption + gap),
                from_bytes(240, 242, 245));
  for (int i = 0; i < count; ++i) {
    const LabelledImage& each = images[static_cast<std::size_t>(i)];
    const int left = gap + i % columns * (width + gap);
    const int top = gap + i / columns * (height + caption + gap);
    draw_text(canvas, static_cast<float>(left), static_cast<float>(top) + dot,
              fitting(each.label, width, dot), dot, kText);
    paste(canvas, left, top + caption, each.image);
  }
  return to_image(canvas);
}

}  // namespace marrow
