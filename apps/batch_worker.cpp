#include "batch_worker.hpp"

#include <marrow/file_io.hpp>
#include <marrow/simd.hpp>
#include <marrow/volume_surface.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <new>

#include "batch_folder.hpp"
#include "map_file.hpp"
#include "picture/png.hpp"
#include "picture/render.hpp"
#include "progress.hpp"
#include "statistics.hpp"

namespace marrow {

namespace {

namespace fs = std::filesystem;

constexpr RenderOptions kPictureSize{480, 360};

void say(int reply, const Statistics& words) {
  std::string line = words.dump(-1, ' ', false, Statistics::error_handler_t::replace) + "\n";
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t put = ::write(reply, rest.data(), rest.size());
    if (put < 0 && errno != EINTR) return;  // nobody listens any more
    if (put > 0) rest.remove_prefix(static_cast<std::size_t>(put));
  }
}

/// Memory that is asked for, not address space: that is what a shape needs whatever the allocator
/// reserves, and asking for more ends in one clear line.
void limit_memory(std::uint64_t bytes) {
  // Embree asks for 128 MiB as it starts and does not touch them.
  constexpr std::uint64_t kUntouched = std::uint64_t{144} << 20;
  if (bytes == 0) return;
  const rlimit limit{bytes + kUntouched, bytes + kUntouched};
  ::setrlimit(RLIMIT_DATA, &limit);
}

/// "-" is standard input elsewhere; in a batch it is a file like any other.
std::string file_path(const std::string& path) { return path == "-" ? "./-" : path; }

CurveSkeleton extract_by(const ExtractionRequest& request, const InputFile& input,
                         const std::variant<Shape, Volume>& shape, Progress& progress) {
  ExtractOptions options = options_of(request);
  options.on_stage = [&](std::string_view stage, double done) {
    if (done < 1) progress.begin(stage, done);
  };
  try {
    return kept_parts(request,
                      std::visit([&](const auto& any) { return extract(any, options); }, shape));
  } catch (const Error& e) {
    throw Error(e.kind(), input.name + ": " + e.what());
  }
}

std::string picture_of(const std::variant<Shape, Volume>& shape, const CurveSkeleton& skeleton) {
  const auto* const mesh = std::get_if<Shape>(&shape);
  if (mesh) return encode_png(render_picture(*mesh, skeleton, kPictureSize));
  const Shape surface = boundary_surface(std::get<Volume>(shape));
  return encode_png(render_picture(surface, skeleton, kPictureSize));
}

std::string output_of(const std::string& kind, const std::variant<Shape, Volume>& shape,
                      const CurveSkeleton& skeleton) {
  if (kind == kPicture) return picture_of(shape, skeleton);
  if (kind.starts_with(kMap)) return map_file(shape, skeleton, map_format_of(kind));
  return format_skeleton(skeleton, output_skeleton_format("-", kind));
}

/// Written to the work folder, where what a killed worker leaves is found, then renamed.
void write_output(const WorkerTask& task, const std::string& kind, const std::string& bytes) {
  const std::string draft = task.work_folder + "/" + std::to_string(::getpid()) + "." + kind;
  const std::string path = output_path(task.outputs.folder, kind, task.item.id);
  write_file(draft, bytes);
  std::error_code error;
  fs::create_directories(fs::path(path).parent_path(), error);
  if (!error) fs::rename(draft, path, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(draft, ignored);
  throw Error(ErrorKind::CannotWrite, path + ": cannot be written: " + error.message());
}

Statistics work(const WorkerTask& task, int reply, Progress& progress) {
  const ExtractionRequest& request = task.options.extraction;
  set_simd_target(request.simd);
  progress.begin("read", 0);
  InputFile input = read_input(file_path(task.item.path), task.options.from, task.limits);
  Statistics about = describe(input);
  say(reply, {{"input", about}});
  const auto shape = shape_or_volume_of(input, request.volume);
  std::string().swap(input.bytes);  // as large as the shape
  about.update(describe_size(shape));
  const CurveSkeleton skeleton = extract_by(request, input, shape, progress);

  progress.begin("write", 1);
  Statistics result{{"input", about}, {"status", "done"}};
  for (const std::string& kind : task.outputs.kinds()) {
    const std::string bytes = output_of(kind, shape, skeleton);
    write_output(task, kind, bytes);
    result["outputs"][kind] = bytes.size();
  }
  result["skeleton"] = statistics_of(skeleton);
  return result;
}

Statistics failure(ErrorKind kind, const std::string& words) {
  return {{"status", name_of(kind)}, {"error", one_line(words)}};
}

Statistics result_of(const WorkerTask& task, int reply, Progress& progress) {
  const std::string& name = task.item.path;
  try {
    return work(task, reply, progress);
  } catch (const Error& e) {
    return failure(e.kind(), e.what());
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::Limit,
                   name + ": needs more memory than there is" +
                       (task.max_memory ? "; raise --max-rss, or simplify it" : "; simplify it"));
  } catch (const std::exception& e) {
    return failure(ErrorKind::Internal, name + ": internal error: " + e.what());
  }
}

}  // namespace

std::vector<std::string> BatchOutputs::kinds() const {
  std::vector<std::string> kinds = formats;
  if (with_picture) kinds.push_back(kPicture);
  if (!map_format.empty()) kinds.push_back(kMap + map_format);
  return kinds;
}

void run_worker(const WorkerTask& task, int reply) {
  limit_memory(task.max_memory);
  Progress progress(true);
  Statistics result = result_of(task, reply, progress);
  Statistics seconds = Statistics::object();
  for (const auto& [stage, time] : progress.finish()) seconds[stage] = time;
  result["run"]["seconds"] = seconds;
  say(reply, result);
}

}  // namespace marrow
