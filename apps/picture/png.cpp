#include "picture/png.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <png.h>

namespace marrow {
namespace {

std::string encode(const std::vector<std::uint8_t>& pixels, int width, int height, int channels) {
  const std::size_t expected = static_cast<std::size_t>(std::max(width, 0)) *
                               static_cast<std::size_t>(std::max(height, 0)) *
                               static_cast<std::size_t>(channels);
  if (expected == 0 || pixels.size() != expected) {
    throw Error(ErrorKind::Internal, "png: the picture is empty or its pixels do not fill it");
  }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;

  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    throw Error(ErrorKind::Limit, std::string("png: ") + header.message + "; make it smaller");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string encode_png(const GreyImage& image) {
  return encode(image.pixels, image.width, image.height, 1);
}

std::string encode_png(const RgbImage& image) {
  return encode(image.pixels, image.width, image.height, 3);
}

void write_png(const std::string& path, const GreyImage& image) {
  write_file(path, encode_png(image));
}

void write_png(const std::string& path, const RgbImage& image) {
  write_file(path, encode_png(image));
}

}  // namespace marrow
