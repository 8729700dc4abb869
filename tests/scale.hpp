// Sizes of test shapes and resolutions: smaller where every instruction is checked.
#pragma once

#include <marrow/extract.hpp>

/// `full`, or `small` in the sanitize preset, which is ten to thirty times slower. For sizes only:
/// a test asserts the same at both.
constexpr int scaled([[maybe_unused]] int full, [[maybe_unused]] int small) {
#ifdef MARROW_SANITIZE
  return small;
#else
  return full;
#endif
}

/// The default options, or images and grids of these sizes in the sanitize preset.
inline marrow::ExtractOptions defaults_or_small(int image, int grid) {
  marrow::ExtractOptions options;
  options.image_resolution = scaled(options.image_resolution, image);
  options.grid_resolution = scaled(options.grid_resolution, grid);
  return options;
}
