// Worker processes: one for each shape, so that what a shape does to it ends there.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace marrow {

/// How a worker ended.
struct WorkerEnd {
  std::size_t item = 0;
  std::string reply;       ///< all that it has said
  int status = 0;          ///< as waitpid() tells it
  bool timed_out = false;  ///< and was killed for it
  double wall_seconds = 0, cpu_seconds = 0;
  std::uint64_t max_rss = 0;  ///< bytes
};

/// Forks a process for each task and watches over all of them from one thread. The caller must
/// have no other threads. Workers die with this process, however it ends.
class WorkerPool {
 public:
  /// `timeout` in seconds, 0 for none.
  explicit WorkerPool(int timeout) : timeout_(timeout) {}
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool() { kill_all(); }

  std::size_t size() const { return workers_.size(); }

  /// Runs `task(reply)` in a new process, without standard files. Throws Error: Limit.
  void start(std::size_t item, const std::function<void(int reply)>& task);

  /// Waits for at most `patience`; the workers that have ended, and the late ones killed.
  std::vector<WorkerEnd> wait(std::chrono::milliseconds patience);

  void kill_all();

 private:
  using Clock = std::chrono::steady_clock;
  struct Worker {
    pid_t pid = 0;
    int reply = -1;
    Clock::time_point start;
    WorkerEnd end;
  };

  void kill_late_ones();
  bool has_ended(Worker& worker, short events);

  int timeout_;
  std::vector<Worker> workers_;
};

}  // namespace marrow
