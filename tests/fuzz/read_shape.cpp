// Bytes as a file of a shape in MARROW_FUZZ_FORMAT: a sound shape, which reads back the same after
// it is written, or one clean error.
#include <marrow/shape_io.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "expect.hpp"

using namespace marrow;

namespace {

constexpr ShapeFormat kFormat = ShapeFormat::MARROW_FUZZ_FORMAT;
constexpr ReadOptions kLimits{.max_bytes = 1 << 20, .max_triangles = 100'000};

std::optional<Shape> read(std::string_view bytes, ShapeFormat format) {
  try {
    return parse_shape(bytes, format, "file", kLimits);
  } catch (const Error& e) {
    fuzz::expect_clean(e);
    return {};
  }
}

std::optional<std::string> written(const Shape& shape, ShapeFormat format) {
  try {
    return format_shape(shape, format);
  } catch (const Error& e) {
    fuzz::expect(e.kind() == ErrorKind::Unsupported, e.what());
    return {};
  }
}

void expect_sound(const Shape& shape) {
  fuzz::expect(!shape.points.empty(), "a shape has points");
  for (const Vec3& p : shape.points)
    fuzz::expect(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                 "points are finite");
  for (const Triangle& t : shape.triangles)
    for (const auto i : t) fuzz::expect(i < shape.points.size(), "indices are in range");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto shape = read({reinterpret_cast<const char*>(data), size}, kFormat);
  if (!shape) return 0;
  expect_sound(*shape);
  // STL rounds to single precision; what came from one is written as another.
  const ShapeFormat format = kFormat == ShapeFormat::Stl ? ShapeFormat::Ply : kFormat;
  const auto bytes = written(*shape, format);
  if (bytes) fuzz::expect(read(*bytes, format) == shape, "a written shape reads back the same");
  return 0;
}
