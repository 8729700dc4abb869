#include "picture/image.hpp"

namespace marrow {

RgbImage to_image(const Canvas& canvas) {
  RgbImage image{canvas.width(), canvas.height(), {}};
  image.pixels.reserve(std::size_t{3} * static_cast<std::size_t>(canvas.width()) *
                       static_cast<std::size_t>(canvas.height()));
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      const Colour& c = canvas.at(x, y);
      for (const float channel : {c.r, c.g, c.b}) image.pixels.push_back(to_byte(channel));
    }
  }
  return image;
}

}  // namespace marrow
