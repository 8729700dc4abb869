#include "batch_run.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <algorithm>
#include <csignal>
#include <deque>
#include <filesystem>
#include <optional>

#include "batch_folder.hpp"
#include "batch_pool.hpp"
#include "batch_progress.hpp"
#include "batch_results.hpp"
#include "batch_row.hpp"

namespace marrow {

namespace {

constexpr int kBatchHadFailures = 9;  // the exit status

volatile std::sig_atomic_t last_signal = 0, signal_count = 0;

extern "C" void note_signal(int signal) {
  last_signal = signal;
  signal_count = signal_count + 1;
}

void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
}

/// The command line as a shell takes it, with --resume.
std::string resume_command() {
  const std::string bytes = read_file("/proc/self/cmdline");
  std::string command;
  bool resumes = false;
  for (std::size_t at = 0; at < bytes.size(); at = bytes.find('\0', at) + 1) {
    const std::string word = bytes.substr(at, bytes.find('\0', at) - at);
    resumes = resumes || word == "--resume";
    const bool is_plain =
        !word.empty() &&
        word.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%") ==
            word.npos;
    std::string quoted;
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    command += (command.empty() ? "" : " ") + (is_plain ? word : "'" + quoted + "'");
  }
  return command + (resumes ? "" : " --resume");
}

class Batch {
 public:
  Batch(const BatchRequest& request, BatchItems list);

  /// False when it was told to stop.
  bool run();
  /// Says what has been done; whether shapes have failed, now or before.
  bool tell_end();

 private:
  struct Tried {
    std::size_t item = 0;
    std::uint64_t attempt = 1;
    bool was_killed = false;
  };

  void fill_pool();
  std::optional<Tried> next();
  bool is_to_be_done(std::size_t item);
  void start(const Tried& tried);
  void finish(const WorkerEnd& end);
  void stop_where_nothing_can_be_written(const Statistics& row);
  void sync_now_and_then();

  const BatchRequest& request_;
  BatchItems list_;
  WorkFolder work_folder_;
  std::vector<Prior> priors_;
  ResultLog log_;
  WorkerPool pool_;
  BatchProgress progress_;
  std::size_t next_ = 0;
  std::deque<Tried> again_;
  std::vector<Tried> running_;
  int unwritten_ = 0;  // shapes in a row
  Stopwatch watch_;
  double synced_ = 0;
};

std::vector<Prior> earlier_results(const BatchRequest& request, const BatchItems& list) {
  const std::string& folder = request.outputs.folder;
  if (!request.resume) {
    for (const std::string& path : results_in(folder))
      if (!is_of_another_shard(path, folder, request.shard))
        throw Error(ErrorKind::Usage, folder +
                                          ": holds results of an earlier run; say --resume to "
                                          "go on with it, or name another folder");
    return std::vector<Prior>(list.items.size());
  }
  std::uint64_t torn = 0;
  std::vector<Prior> priors = priors_of(list.items, folder, request.shard, torn);
  if (torn > 0 && !request.quiet)
    warn(folder + ": lines of results that are torn and do not count: " + std::to_string(torn));
  return priors;
}

Batch::Batch(const BatchRequest& request, BatchItems list)
    : request_(request),
      list_(std::move(list)),
      work_folder_(request.outputs.folder, request.shard),
      priors_(earlier_results(request, list_)),
      log_(results_path(request.outputs.folder, request.shard)),
      pool_(request.limits.timeout),
      progress_(list_.items.size(), request.quiet) {}

bool Batch::run() {
  constexpr std::chrono::milliseconds kPatience(100);
  fill_pool();
  while (pool_.size() > 0) {
    for (const WorkerEnd& end : pool_.wait(kPatience)) finish(end);
    if (signal_count > 1) return false;
    fill_pool();
    progress_.show();
    sync_now_and_then();
  }
  log_.sync();
  return last_signal == 0;
}

bool Batch::tell_end() {
  progress_.finish(request_.outputs.folder);
  return progress_.has_failures();
}

void Batch::fill_pool() {
  while (last_signal == 0 && pool_.size() < static_cast<std::size_t>(request_.jobs)) {
    const auto tried = next();
    if (!tried) return;
    start(*tried);
  }
}

std::optional<Batch::Tried> Batch::next() {
  while (next_ < list_.items.size() && last_signal == 0) {
    const std::size_t item = next_++;
    if (is_to_be_done(item)) return Tried{item, priors_[item].attempt + 1};
    progress_.skip(priors_[item].is_done);
    progress_.show();
  }
  if (again_.empty() || last_signal != 0) return {};
  const Tried tried = again_.front();
  again_.pop_front();
  return tried;
}

bool Batch::is_to_be_done(std::size_t item) {
  const Prior& prior = priors_[item];
  if (prior.attempt == 0 || prior.is_to_repeat || (request_.retry && !prior.is_done)) return true;
  const BatchItem& what = list_.items[item];
  const Statistics row = row_before(what, list_.options[what.options], request_.outputs);
  return !is_unchanged(prior, row, what, request_.outputs);
}

void Batch::start(const Tried& tried) {
  const BatchItem& item = list_.items[tried.item];
  const WorkerTask task{item,
                        list_.options[item.options],
                        request_.outputs,
                        work_folder_.path(),
                        request_.limits.read,
                        request_.max_memory};
  running_.push_back(tried);
  pool_.start(tried.item, [&](int reply) { run_worker(task, reply); });
}

void Batch::finish(const WorkerEnd& end) {
  const auto at = std::find_if(running_.begin(), running_.end(),
                               [&](const Tried& tried) { return tried.item == end.item; });
  const Tried tried = *at;
  running_.erase(at);
  const BatchItem& item = list_.items[end.item];
  const Statistics row = row_after(row_before(item, list_.options[item.options], request_.outputs),
                                   item, end, tried.attempt, request_.limits.timeout);
  if (text_at(row, "status") == kKilled && (!tried.was_killed || last_signal != 0)) {
    // Who ends this process may have ended its workers first.
    again_.push_back({tried.item, tried.attempt, true});
    return;
  }
  log_.append(row);
  progress_.add(text_at(row, "status"));
  stop_where_nothing_can_be_written(row);
}

void Batch::stop_where_nothing_can_be_written(const Statistics& row) {
  constexpr int kMost = 5;
  unwritten_ = text_at(row, "status") == "cannot-write" ? unwritten_ + 1 : 0;
  if (unwritten_ == kMost)
    throw Error(ErrorKind::CannotWrite, text_at(row, "error") +
                                            "; mend it and run again with "
                                            "--resume");
}

/// After a crash of the machine at most the last second is missing.
void Batch::sync_now_and_then() {
  const double now = watch_.seconds();
  if (now - synced_ < 1) return;
  log_.sync();
  synced_ = now;
}

void refuse_empty(const BatchRequest& request, const ItemList& list) {
  if (list.size() > 0) return;
  std::string where = request.sources.manifest;
  for (const std::string& input : request.sources.inputs)
    where += (where.empty() ? "" : ", ") + input;
  throw Error(ErrorKind::Usage, where + ": holds no shapes");
}

}  // namespace

int run_batch(const BatchRequest& request) {
  ItemList list(request.shard, request.options);
  add_sources(request.sources, list);
  refuse_empty(request, list);
  listen_to_signals();
  Batch batch(request, std::move(list).take());
  const bool is_whole = batch.run();
  const bool has_failures = batch.tell_end();
  if (is_whole) return has_failures ? kBatchHadFailures : 0;
  std::fprintf(stderr, "marrow: stopped; to go on: %s\n", one_line(resume_command()).c_str());
  return 128 + last_signal;
}

}  // namespace marrow
