// Pictures as PNG.
#pragma once

#include <string>

#include "picture/image.hpp"

namespace marrow {

/// The bytes of a PNG file. The same pixels give the same bytes; no time, no names in it.
/// Throws Error: Internal (the pixels are not width x height), Limit (too large for the format).
std::string encode_png(const GreyImage& image);
std::string encode_png(const RgbImage& image);

/// Writes the file whole or not at all; "-" is standard output. Throws Error: CannotWrite.
void write_png(const std::string& path, const GreyImage& image);
void write_png(const std::string& path, const RgbImage& image);

}  // namespace marrow
