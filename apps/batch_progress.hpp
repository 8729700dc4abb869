// How far a batch is: a line that is drawn again on a terminal, lines apart elsewhere.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "progress.hpp"

namespace marrow {

class BatchProgress {
 public:
  BatchProgress(std::size_t total, bool quiet);

  void skip(bool is_done);                ///< one that an earlier run has done, or has failed at
  void add(const std::string& status);    ///< one that has ended
  void show();                            ///< if the last time is long enough ago
  void finish(const std::string& where);  ///< the last line, with the causes of the failures

  bool has_failures() const { return failures_ + failed_before_ > 0; }

 private:
  std::string line() const;

  std::size_t total_, done_before_ = 0, failed_before_ = 0, ended_ = 0, failures_ = 0;
  std::map<std::string, std::size_t> causes_;
  bool quiet_, on_terminal_;
  double shown_ = 0;
  Stopwatch watch_;
};

}  // namespace marrow
