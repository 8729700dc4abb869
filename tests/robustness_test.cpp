// Hostile shapes: whatever comes in, a valid skeleton comes out, or an Error.
#include <marrow/error.hpp>
#include <marrow/extract.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "catch.hpp"
#include "scale.hpp"
#include "skeleton_faults.hpp"

using namespace marrow;

namespace {

/// Numbers that are the same everywhere.
class Lcg {
 public:
  explicit Lcg(std::uint64_t seed) : state_(seed * 7919 + 12345) {}
  double unit() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  Vec3 point() {
    const double x = 2 * unit() - 1, y = 2 * unit() - 1;
    return {x, y, 2 * unit() - 1};
  }

 private:
  std::uint64_t state_;
};

void add(Shape& shape, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(shape.points.size());
  shape.points.insert(shape.points.end(), {a, b, c});
  shape.triangles.push_back({first, first + 1, first + 2});
}

Shape soup(int triangles, const std::function<Vec3()>& point) {
  Shape shape;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 a = point(), b = point();
    add(shape, a, b, point());
  }
  return shape;
}

/// A rod of square section along (1, 1, 1).
Shape rod(double radius) {
  const Vec3 end{1, 1, 1}, u = Vec3{radius, -radius, 0}, v = Vec3{radius, radius, -2 * radius};
  const std::array<Vec3, 4> rim{u, v, -u, -v};
  Shape shape;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = rim[i], &b = rim[(i + 1) % 4];
    add(shape, a - end, b - end, b + end);
    add(shape, a - end, b + end, a + end);
  }
  return shape;
}

ExtractOptions small_options() {
  ExtractOptions options;
  options.image_resolution = 64;
  options.grid_resolution = 32;
  return options;
}

void require_valid(const CurveSkeleton& skeleton, const Shape& shape) {
  const std::string fault = test::fault_of(skeleton, shape, small_options().image_resolution);
  INFO(fault);
  REQUIRE(fault.empty());
}

/// The skeleton, or the kind of error where there is none.
struct Outcome {
  CurveSkeleton skeleton;
  std::optional<ErrorKind> error;

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome_of(const Shape& shape, int threads) {
  ExtractOptions options = small_options();
  options.max_threads = threads;
  try {
    return {extract(shape, options), {}};
  } catch (const Error& e) {
    return {{}, e.kind()};
  }
}

/// Also that it is the same a second time, with another number of threads.
void require_valid_or_error(const Shape& shape, ErrorKind error = ErrorKind::Empty) {
  const Outcome outcome = outcome_of(shape, 0);
  if (outcome.error)
    REQUIRE(*outcome.error == error);
  else
    require_valid(outcome.skeleton, shape);
  REQUIRE(outcome_of(shape, 1) == outcome);
}

}  // namespace

TEST_CASE("random soups give a valid skeleton or an error", "[robustness]") {
  for (std::uint64_t seed = 0; seed < std::uint64_t{scaled(40, 6)}; ++seed) {
    CAPTURE(seed);
    Lcg random(seed);
    const double most = seed % 4 == 0 ? 1000 : 200;
    const int triangles = 1 + static_cast<int>(random.unit() * most);
    require_valid_or_error(soup(triangles, [&] { return random.point(); }));
  }
}

TEST_CASE("soups of small and large triangles, each a few times over", "[robustness]") {
  for (std::uint64_t seed = 0; seed < std::uint64_t{scaled(20, 3)}; ++seed) {
    CAPTURE(seed);
    Lcg random(seed);
    Shape shape;
    for (int i = 0; i < 100; ++i) {
      const double size = std::pow(10.0, -9 * random.unit());
      const Vec3 a = random.point(), b = a + random.point() * size, c = a + random.point() * size;
      add(shape, a, b, c);
      if (i % 3 == 0) shape.triangles.insert(shape.triangles.end(), 4, shape.triangles.back());
      if (i % 5 == 0) add(shape, c, b, a);
      if (i % 7 == 0) add(shape, a, b, b);
      if (i % 9 == 0) add(shape, a, a + (c - a) * 0.5, c);
    }
    require_valid_or_error(shape);
  }
}

TEST_CASE("coordinates of all magnitudes at once", "[robustness]") {
  for (std::uint64_t seed = 0; seed < std::uint64_t{scaled(20, 3)}; ++seed) {
    CAPTURE(seed);
    Lcg random(seed);
    const double range = seed % 2 == 0 ? 300 : 30;
    require_valid_or_error(soup(1 + static_cast<int>(random.unit() * 100), [&] {
      const double size = std::pow(10.0, range * (2 * random.unit() - 1));
      return random.point() * size;
    }));
  }
}

TEST_CASE("a point that is not finite or not there is refused where it counts", "[robustness]") {
  using Limits = std::numeric_limits<double>;
  for (const double value : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    CAPTURE(value);
    for (const std::size_t at : {0, 17, 59}) {
      Lcg random(3);
      Shape shape = soup(20, [&] { return random.point(); });
      shape.points[at].y = value;
      CHECK(outcome_of(shape, 0).error == ErrorKind::Malformed);
      shape.triangles.erase(shape.triangles.begin() + static_cast<std::ptrdiff_t>(at / 3));
      require_valid(outcome_of(shape, 0).skeleton, shape);
    }
  }
  Shape shape = rod(0.1);
  shape.triangles[3][1] = static_cast<std::uint32_t>(shape.points.size());
  CHECK(outcome_of(shape, 0).error == ErrorKind::Malformed);
}

TEST_CASE("soups along a line, in a plane and of needles", "[robustness]") {
  for (std::uint64_t seed = 0; seed < std::uint64_t{scaled(10, 2)}; ++seed) {
    CAPTURE(seed);
    Lcg random(seed);
    const Vec3 a = random.point(), d = random.point(), e = random.point();
    require_valid_or_error(soup(20, [&] { return a + d * random.unit(); }));
    require_valid_or_error(soup(20, [&] { return a + d * random.unit() + e * random.unit(); }));
    require_valid_or_error(
        soup(20, [&] { return random.point() * (random.unit() < 0.5 ? 1e-9 : 1); }));
  }
}

TEST_CASE("shapes at both ends of the range of numbers keep radii and extent", "[robustness]") {
  // 1e-6 of the diagonal was a radius of zero, and positions were rounded to multiples of 1e-300.
  for (const double scale : {5e-324, 1e-322, 1e-310, 1e-300, 1e-150, 1e150, 1e300, 1.7e308}) {
    CAPTURE(scale);
    Lcg random(7);
    const Shape shape = soup(20, [&] { return random.point() * scale; });
    require_valid_or_error(shape);
  }
  Shape shape = rod(0.1);
  const CurveSkeleton plain = extract(shape, small_options());
  for (auto& p : shape.points) p = p * 1e-300;
  CurveSkeleton tiny = extract(shape, small_options());
  for (auto& n : tiny.nodes) n.position = n.position * 1e300;
  CHECK(total_length(tiny) == Approx(total_length(plain)).epsilon(0.01));
}

TEST_CASE("a rod thinner than a pixel is one line, however fine the grid", "[robustness]") {
  ExtractOptions options = small_options();
  options.grid_resolution = 128;  // voxels finer than pixels: votes do not touch each other
  for (const double radius : {1e-3, 1e-5, 1e-7}) {
    CAPTURE(radius);
    const CurveSkeleton skeleton = extract(rod(radius), options);
    require_valid(skeleton, rod(radius));
    CHECK(total_length(skeleton) > 1);
  }
}
