#include "batch_row.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <vector>

#include "batch_folder.hpp"
#include "hash.hpp"

namespace marrow {

namespace {

namespace fs = std::filesystem;

/// Whether a worker was killed, but not by us nor by what its shape did.
bool was_killed(const WorkerEnd& end) {
  if (end.timed_out) return false;
  if (WIFSIGNALED(end.status)) return WTERMSIG(end.status) == SIGKILL;
  // What the handlers of prepare_process() end with.
  const int status = WEXITSTATUS(end.status);
  return status == 128 + SIGINT || status == 128 + SIGTERM || status == 128 + SIGHUP;
}

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

/// Takes each whole line of the reply over, later keys over earlier ones.
void add_reply(Statistics& row, std::string_view reply) {
  while (!reply.empty()) {
    const std::size_t end = reply.find('\n');
    if (end == std::string_view::npos) return;
    const Statistics part = Statistics::parse(reply.substr(0, end), nullptr, false);
    if (part.is_object()) row.update(part);
    reply.remove_prefix(end + 1);
  }
}

/// For a worker that could not say it any more.
void add_death(Statistics& row, const BatchItem& item, const WorkerEnd& end, int timeout) {
  if (end.timed_out) {
    row["status"] = "timeout";
    row["error"] = one_line(item.path + ": took longer than the limit of " +
                            std::to_string(timeout) + " s; raise --timeout or simplify the file");
    return;
  }
  std::string words = ": the worker ended with status " + std::to_string(WEXITSTATUS(end.status));
  if (WIFSIGNALED(end.status))
    words = std::string(": the worker crashed: ") + ::strsignal(WTERMSIG(end.status));
  if (was_killed(end)) words = ": the worker was killed, twice; is there enough memory?";
  row["status"] = was_killed(end) ? kKilled : "crash";
  row["error"] = one_line(item.path + words);
}

/// "" for what is no plain file, and for a file that cannot be read.
std::string hash_of_file(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return "";
  struct stat status {};
  std::uint64_t hash = kFirstHash;
  bool is_read = ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
  std::vector<char> piece(std::size_t{1} << 18);
  while (is_read) {
    const ssize_t got = ::read(fd, piece.data(), piece.size());
    is_read = got >= 0;
    if (got <= 0) break;
    hash = hash_on(hash, {piece.data(), static_cast<std::size_t>(got)});
  }
  ::close(fd);
  return is_read ? "fnv1a64:" + hex_of(hash) : "";
}

bool are_there(const std::vector<std::uint64_t>& sizes, const BatchItem& item,
               const BatchOutputs& outputs) {
  const std::vector<std::string> kinds = outputs.kinds();
  if (sizes.size() != kinds.size()) return false;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    std::error_code error;
    if (fs::file_size(output_path(outputs.folder, kinds[i], item.id), error) != sizes[i] || error)
      return false;
  }
  return true;
}

}  // namespace

Statistics row_before(const BatchItem& item, const ShapeOptions& options,
                      const BatchOutputs& outputs) {
  const ExtractionRequest& request = options.extraction;
  const std::string format = options.from.empty() ? input_format_of(item.path) : options.from;
  InputFile file;
  file.format = format;
  Statistics row;
  row["id"] = item.id;
  row["input"]["file"] = item.path;
  row["options"] = describe(request, is_volume(file));
  if (!options.from.empty()) row["options"]["from"] = options.from;
  if (format == "raw") {
    row["options"]["dims"] = request.volume.dims;
    row["options"]["type"] = request.volume.type;
    row["options"]["spacing"] = request.volume.spacing;
  }
  row["options"]["outputs"] = outputs.kinds();
  row["version"] = program_version();
  return row;
}

Statistics row_after(Statistics row, const BatchItem& item, const WorkerEnd& end,
                     std::uint64_t attempt, int timeout) {
  add_reply(row, end.reply);
  if (!row.contains("status")) add_death(row, item, end, timeout);
  const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
  Statistics run = {{"ended", now.count()}, {"attempt", attempt}, {"host", host_name()}};
  run["wall_seconds"] = end.wall_seconds;
  run["cpu_seconds"] = end.cpu_seconds;
  run["max_rss"] = end.max_rss;
  if (row.contains("run")) run.update(row["run"]);
  row.erase("run");  // it comes last
  row["run"] = run;
  return row;
}

bool is_unchanged(const Prior& prior, const Statistics& row, const BatchItem& item,
                  const BatchOutputs& outputs) {
  if (prior.setting != setting_of(row)) return false;
  if (prior.is_done && !are_there(prior.output_sizes, item, outputs)) return false;
  // What could not be read the last time has no hash: only --retry asks again.
  return prior.hash.empty() || prior.hash == hash_of_file(item.path);
}

}  // namespace marrow
