#include <marrow/extract_many.hpp>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <new>

namespace marrow {

namespace {

ExtractResult extract_one(const Shape& shape, const ExtractOptions& options) {
  try {
    return {extract(shape, options), {}};
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::Usage) throw;
    return {{}, e};
  } catch (const std::bad_alloc&) {
    return {{}, Error(ErrorKind::Limit, "out of memory; use fewer threads or a smaller shape")};
  }
}

}  // namespace

std::vector<ExtractResult> extract_many(std::span<const Shape> shapes,
                                        const ExtractOptions& options) {
  std::vector<ExtractResult> results(shapes.size());
  std::optional<tbb::global_control> limit;
  const int threads = options.max_threads;
  if (threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  // The limit is that of the process: views ask for as many threads as there are, and get those
  // that no other shape keeps busy. A limit of their own would hold the other shapes up.
  ExtractOptions for_each = options;
  for_each.max_threads = threads < 0 ? threads : 0;
  for_each.on_stage = nullptr;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, shapes.size(),
        [&](std::size_t i) { results[i] = extract_one(shapes[i], for_each); },
        tbb::simple_partitioner{});
  });
  return results;
}

}  // namespace marrow
