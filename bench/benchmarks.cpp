// One benchmark for every stage and one for whole extractions, in user CPU time on one thread:
//   marrow_benchmarks                           on a few shapes of `marrow make`
//   marrow_benchmarks --make=hand,plant:4       on these, the plant with 4 times the faces
//   marrow_benchmarks --shapes=FOLDER,FILE      on files
//   marrow_benchmarks --threads=2 --image=512 --grid=128 --simd=AVX2 --per-view
// and all that Google Benchmark knows, such as --benchmark_filter=silhouettes.
#include <marrow/error.hpp>
#include <marrow/simd.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>

#include "request.hpp"
#include "stages.hpp"
#include "user_clock.hpp"

namespace marrow {

namespace {

/// The shape that is being measured; one at a time, for shapes may be large.
class Bench {
 public:
  explicit Bench(ExtractOptions options) : options_(std::move(options)) {}

  const ExtractOptions& options() const { return options_; }
  const Shape& shape(const ShapeSource& source) {
    if (name_ != source.name) {
      work_.reset();
      shape_ = load(source);
      name_ = source.name;
    }
    return work_ ? work_->shape : shape_;
  }
  const Workload& workload(const ShapeSource& source) {
    shape(source);
    if (!work_) work_ = prepare(std::move(shape_), options_);
    return *work_;
  }

 private:
  ExtractOptions options_;
  std::string name_;
  Shape shape_;
  std::optional<Workload> work_;
};

/// Measures `work()` in user CPU time; the other clocks become counters, in milliseconds.
template <class Work>
void measure(benchmark::State& state, const Shape& shape, Work work) {
  Clocks sum;
  for ([[maybe_unused]] auto _ : state) {
    const Clocks start = read_clocks();
    work();
    const Clocks spent = read_clocks() - start;
    // Not zero, or Google Benchmark would never have enough of a stage that has nothing to do.
    state.SetIterationTime(std::max(spent.user, 1e-6));
    sum += spent;
  }
  const auto each = benchmark::Counter::kAvgIterations;
  state.counters["wall_ms"] = benchmark::Counter(1e3 * sum.wall, each);
  state.counters["system_ms"] = benchmark::Counter(1e3 * sum.system, each);
  state.counters["faces"] = static_cast<double>(shape.triangles.size());
}

/// Whole extractions; what extract() itself calls stages becomes counters "in NAME", wall clock in
/// milliseconds.
void measure_extract(benchmark::State& state, const Shape& shape, ExtractOptions options) {
  std::vector<std::pair<std::string, double>> seconds;
  std::string stage;
  double begin = 0;
  options.on_stage = [&](std::string_view next, double) {
    const double now = read_clocks().wall;
    const auto known = std::ranges::find(seconds, stage, &std::pair<std::string, double>::first);
    if (known != seconds.end())
      known->second += now - begin;
    else if (!stage.empty())
      seconds.emplace_back(stage, now - begin);
    stage = next == "done" ? "" : next;
    begin = now;
  };
  measure(state, shape, [&] { benchmark::DoNotOptimize(extract(shape, options).nodes.data()); });
  for (const auto& [name, sum] : seconds)
    state.counters["in " + name] =
        benchmark::Counter(1e3 * sum, benchmark::Counter::kAvgIterations);
}

/// Registers `run(state)` as "stage/shape"; an Error ends this benchmark, not the others.
template <class Run>
void add(const std::string& stage, const ShapeSource& source, Run run) {
  const auto guarded = [run](benchmark::State& state) {
    try {
      run(state);
    } catch (const Error& e) {
      state.SkipWithError(e.what());
    }
  };
  benchmark::RegisterBenchmark((stage + "/" + source.name).c_str(), guarded)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_all(const BenchRequest& request, const std::shared_ptr<Bench>& bench) {
  for (const ShapeSource& source : request.shapes) {
    add("extract", source, [=](benchmark::State& state) {
      measure_extract(state, bench->shape(source), bench->options());
    });
    for (const Stage& stage : stages())
      add(stage.name, source, [=](benchmark::State& state) {
        const Workload& work = bench->workload(source);
        measure(state, work.shape, [&] { stage.run(work); });
      });
    if (!request.per_view) continue;
    for (std::size_t view = 0; view < hemisphere_directions().size(); ++view)
      add("view-" + std::to_string(view), source, [=](benchmark::State& state) {
        const Workload& work = bench->workload(source);
        measure(state, work.shape, [&] { draw_view_pair(work, view); });
      });
  }
}

std::string machine() {
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

void describe(const BenchRequest& request) {
  const ExtractOptions& options = request.options;
  benchmark::AddCustomContext("machine", machine());
  benchmark::AddCustomContext("compiler", MARROW_BENCH_COMPILER);
  const int image = options.image_resolution;
  benchmark::AddCustomContext("image", image > 0 ? std::to_string(image) : "as the shape needs");
  benchmark::AddCustomContext("grid", std::to_string(options.grid_resolution));
  benchmark::AddCustomContext("threads", std::to_string(options.max_threads));
  benchmark::AddCustomContext("simd", request.simd.empty() ? simd_targets()[0] : request.simd);
}

int run(int argc, char** argv) {
  std::vector<std::string> arguments(argv, argv + argc);
  const BenchRequest request = take_request(arguments);
  // Before the user's words, so that those win.
  arguments.insert(arguments.begin() + 1,
                   {"--benchmark_repetitions=5", "--benchmark_min_time=0.1"});
  std::vector<char*> words;
  for (auto& argument : arguments) words.push_back(argument.data());
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, words.data());
  if (benchmark::ReportUnrecognizedArguments(count, words.data())) return 2;
  set_simd_target(request.simd);
  describe(request);
  add_all(request, std::make_shared<Bench>(request.options));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

}  // namespace marrow

int main(int argc, char** argv) {
  try {
    return marrow::run(argc, argv);
  } catch (const marrow::Error& e) {
    std::fprintf(stderr, "marrow_benchmarks: %s\n", e.what());
    return static_cast<int>(e.kind());
  }
}
