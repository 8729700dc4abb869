// The clocks that the benchmarks read.
#pragma once

#include <sys/resource.h>

#include <chrono>

namespace marrow {

/// Seconds since some fixed time, by three clocks.
struct Clocks {
  double user = 0;    ///< CPU time of the process, all threads, outside the kernel
  double system = 0;  ///< CPU time of the process inside the kernel
  double wall = 0;

  friend Clocks operator-(const Clocks& a, const Clocks& b) {
    return {a.user - b.user, a.system - b.system, a.wall - b.wall};
  }
  Clocks& operator+=(const Clocks& b) {
    user += b.user, system += b.system, wall += b.wall;
    return *this;
  }
};

inline Clocks read_clocks() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {seconds(usage.ru_utime), seconds(usage.ru_stime),
          std::chrono::duration<double>(wall).count()};
}

}  // namespace marrow
