#include "batch_pool.hpp"

#include <marrow/error.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "process.hpp"

namespace marrow {

namespace {

constexpr std::size_t kLongestReply = std::size_t{4} << 20;

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Where memory runs out, a worker is to go rather than who watches over it.
void offer_to_be_killed() {
  const int fd = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (fd < 0) return;
  const ssize_t ignored = ::write(fd, "500", 3);
  static_cast<void>(ignored);
  ::close(fd);
}

/// A group of its own: Ctrl-C is for the parent only, and what a worker starts can be killed with
/// it.
void become_worker(pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before it could be watched
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, fd);
  prepare_process();
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  offer_to_be_killed();
}

[[noreturn]] void be_worker(pid_t parent, int reply, const std::function<void(int)>& task) {
  try {
    become_worker(parent);
    task(reply);
    ::_exit(0);
  } catch (...) {
    ::_exit(1);
  }
}

[[noreturn]] void cannot_start(int error) {
  throw Error(ErrorKind::Limit, std::string("no worker can be started: ") + std::strerror(error) +
                                    "; use fewer --jobs");
}

}  // namespace

void WorkerPool::start(std::size_t item, const std::function<void(int reply)>& task) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) cannot_start(errno);
  const pid_t parent = ::getpid();
  const Clock::time_point begin = Clock::now();
  const pid_t pid = ::fork();
  const int error = errno;
  if (pid == 0) {
    ::close(ends[0]);
    be_worker(parent, ends[1], task);
  }
  ::close(ends[1]);
  if (pid < 0) {
    ::close(ends[0]);
    cannot_start(error);
  }
  ::setpgid(pid, pid);  // whichever of the two comes first
  Worker worker{pid, ends[0], begin, {}};
  worker.end.item = item;
  workers_.push_back(std::move(worker));
}

std::vector<WorkerEnd> WorkerPool::wait(std::chrono::milliseconds patience) {
  std::vector<pollfd> replies;
  for (const Worker& worker : workers_) replies.push_back({worker.reply, POLLIN, 0});
  if (::poll(replies.data(), replies.size(), static_cast<int>(patience.count())) < 0)
    for (pollfd& reply : replies) reply.revents = 0;
  kill_late_ones();
  std::vector<WorkerEnd> ended;
  std::vector<Worker> others;
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    if (has_ended(workers_[i], replies[i].revents))
      ended.push_back(std::move(workers_[i].end));
    else
      others.push_back(std::move(workers_[i]));
  }
  workers_ = std::move(others);
  return ended;
}

void WorkerPool::kill_late_ones() {
  if (timeout_ == 0) return;
  const auto earliest = Clock::now() - std::chrono::seconds(timeout_);
  for (Worker& worker : workers_) {
    if (worker.end.timed_out || worker.start > earliest) continue;
    worker.end.timed_out = true;
    ::kill(-worker.pid, SIGKILL);
  }
}

/// Its end of the pipe is closed by its end, whatever that was.
bool WorkerPool::has_ended(Worker& worker, short events) {
  if (events == 0) return false;
  char piece[1 << 16];
  const ssize_t got = ::read(worker.reply, piece, sizeof piece);
  if (got < 0) return false;
  worker.end.reply.append(piece, static_cast<std::size_t>(got));
  if (got > 0 && worker.end.reply.size() <= kLongestReply) return false;
  ::kill(-worker.pid, SIGKILL);  // it may have started others
  ::close(worker.reply);
  rusage usage{};
  while (::wait4(worker.pid, &worker.end.status, 0, &usage) < 0 && errno == EINTR) {
  }
  worker.end.wall_seconds = std::chrono::duration<double>(Clock::now() - worker.start).count();
  worker.end.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  worker.end.max_rss = static_cast<std::uint64_t>(usage.ru_maxrss) << 10;
  return true;
}

void WorkerPool::kill_all() {
  for (const Worker& worker : workers_) {
    ::kill(-worker.pid, SIGKILL);
    ::close(worker.reply);
    while (::waitpid(worker.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  workers_.clear();
}

}  // namespace marrow
