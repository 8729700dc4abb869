// What the benchmarks are asked to run on.
#pragma once

#include <marrow/extract.hpp>
#include <marrow/shape.hpp>

#include <string>
#include <vector>

namespace marrow {

/// A shape of `marrow make`, "NAME" or "NAME:RESOLUTION", or a file.
struct ShapeSource {
  std::string name;  ///< for the names of the benchmarks
  std::string path;  ///< empty: made
  double resolution = 1;
};

struct BenchRequest {
  std::vector<ShapeSource> shapes;
  ExtractOptions options;
  std::string simd;       ///< name of an instruction set; empty: the best
  bool per_view = false;  ///< also each of the 21 views alone
};

/// Takes our own options out of the command line and leaves Google Benchmark's: --make=NAMES,
/// --shapes=PATHS (files and folders; also in the environment as MARROW_BENCH_SHAPES), --image=N,
/// --grid=N, --threads=N, --simd=NAME, --per-view. Throws Error: Usage, CannotRead.
BenchRequest take_request(std::vector<std::string>& arguments);

/// Throws Error as read_shape() and make_analytic_shape() do.
Shape load(const ShapeSource& source);

}  // namespace marrow
