// Bytes as a soup of triangles, or as a point cloud: a valid skeleton comes out, the same with one
// thread and with two, or one clean error.
//
// The first byte is the grid and the threads, the second the number of points. A point is three
// coordinates of two bytes, then all that is left are triangles, of one byte for each corner.
#include <marrow/extract.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "../skeleton_faults.hpp"
#include "expect.hpp"

using namespace marrow;

namespace {

constexpr int kImage = 64;
constexpr std::size_t kMostTriangles = 200;

class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }
  std::uint8_t next() {
    if (bytes_.empty()) return 0;
    const std::uint8_t b = bytes_[0];
    bytes_ = bytes_.subspan(1);
    return b;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Whole numbers from -127 to 127 in halves, quarters, ... and what is at the ends of the range.
double coordinate(Bytes& bytes) {
  using Limits = std::numeric_limits<double>;
  static constexpr std::array kOdd{1.0,
                                   0.5,
                                   0x1p-10,
                                   1e-30,
                                   1e-300,
                                   5e-324,
                                   1e30,
                                   1e100,
                                   1e300,
                                   Limits::max(),
                                   Limits::epsilon(),
                                   1 / 3.0,
                                   1e-12,
                                   1e12,
                                   Limits::infinity(),
                                   Limits::quiet_NaN()};
  const auto number = static_cast<std::int8_t>(bytes.next());
  const std::uint8_t kind = bytes.next();
  return kind < 128 ? number * (1 / 128.0) + kind * 0x1p-14 : number * kOdd[kind % kOdd.size()];
}

Shape soup(Bytes& bytes) {
  Shape shape;
  const int points = 1 + bytes.next();
  for (int i = 0; i < points && bytes.left() > 6; ++i) {
    const double x = coordinate(bytes), y = coordinate(bytes);
    shape.points.push_back({x, y, coordinate(bytes)});
  }
  const auto corner = [&] {
    return static_cast<std::uint32_t>(bytes.next() % shape.points.size());
  };
  while (bytes.left() >= 3 && !shape.points.empty() && shape.triangles.size() < kMostTriangles) {
    const auto a = corner(), b = corner();
    shape.triangles.push_back({a, b, corner()});
  }
  return shape;
}

std::optional<CurveSkeleton> skeleton_of(const Shape& shape, const ExtractOptions& options) {
  try {
    return extract(shape, options);
  } catch (const Error& e) {
    const bool is_clean = e.kind() == ErrorKind::Empty || e.kind() == ErrorKind::Malformed;
    fuzz::expect(is_clean, e.what());
    return {};
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes({data, size});
  const std::uint8_t choices = bytes.next();
  ExtractOptions options;
  options.image_resolution = kImage;
  options.grid_resolution = 16 + choices % 9;
  options.max_threads = 1;
  const Shape shape = soup(bytes);
  const auto skeleton = skeleton_of(shape, options);
  if (skeleton) {
    const std::string fault = test::fault_of(*skeleton, shape, kImage);
    fuzz::expect(fault.empty(), fault);
  }
  if (choices < 128) return 0;
  options.max_threads = 2;
  fuzz::expect(skeleton_of(shape, options) == skeleton, "two threads give the same as one");
  return 0;
}
