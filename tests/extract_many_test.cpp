#include <marrow/extract_many.hpp>
#include <marrow/skeleton_io.hpp>

#include <analytic_shapes.hpp>
#include <tbb/global_control.h>

#include <string>
#include <vector>

#include "catch.hpp"

using namespace marrow;

namespace {

ExtractOptions quick() {
  ExtractOptions options;
  options.image_resolution = 96;
  options.grid_resolution = 32;
  return options;
}

std::vector<Shape> some_shapes() {
  std::vector<Shape> shapes;
  for (const char* name : {"torus", "y", "capsule", "figure-eight", "star"})
    shapes.push_back(make_analytic_shape(name, {0.5}).shape);
  shapes.insert(shapes.begin() + 2, Shape{});
  return shapes;
}

std::string text_of(const CurveSkeleton& skeleton) {
  return format_skeleton(skeleton, SkeletonFormat::Json);
}

}  // namespace

TEST_CASE("many shapes give what each of them gives alone", "[extract_many]") {
  const std::vector<Shape> shapes = some_shapes();
  std::vector<std::string> alone;
  for (const Shape& shape : shapes)
    alone.push_back(shape.points.empty() ? "" : text_of(extract(shape, quick())));

  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {0, 1, 2, 3, 8}) {
    ExtractOptions options = quick();
    options.max_threads = threads;
    const std::vector<ExtractResult> results = extract_many(shapes, options);
    REQUIRE(results.size() == shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      INFO("shape " << i << ", threads " << threads);
      REQUIRE(results[i].error.has_value() == shapes[i].points.empty());
      if (!results[i].error) REQUIRE(text_of(results[i].skeleton) == alone[i]);
    }
    REQUIRE(results[2].error->kind() == ErrorKind::Empty);
  }
}

TEST_CASE("no shapes give nothing, wrong options an error for all", "[extract_many]") {
  REQUIRE(extract_many({}, quick()).empty());
  ExtractOptions options = quick();
  options.grid_resolution = 1;
  REQUIRE_THROWS_AS(extract_many(some_shapes(), options), Error);
  options = quick();
  options.max_threads = -1;
  REQUIRE_THROWS_AS(extract_many(some_shapes(), options), Error);
}
