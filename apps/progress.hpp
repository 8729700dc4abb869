// How far the work is, and how long each stage of it took.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace marrow {

/// Seconds since some fixed time.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// Whether standard error is a terminal, and NO_COLOR, CI or TERM=dumb in the environment do not
/// ask for quiet.
bool terminal_wants_a_bar();

/// A bar on standard error, when a terminal wants one, nobody asked for quiet and the work takes
/// longer than half a second. It is gone when the work is done.
class Progress {
 public:
  explicit Progress(bool quiet);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// A stage begins; `done` is the share of the work before it.
  void begin(std::string_view stage, double done);
  /// Ends the last stage and clears the line; times of all stages in their order.
  std::vector<StageTime> finish();

 private:
  void draw(std::string_view stage, double done);
  void clear();

  bool wanted_, drawn_ = false;
  Stopwatch watch_;
  double stage_start_ = 0;
  std::vector<StageTime> times_;
};

}  // namespace marrow
