#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace marrow {

namespace {

constexpr double kPatience = 0.5;  // seconds without a bar
constexpr int kWidth = 30;         // of the bar, in characters

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

}  // namespace

bool terminal_wants_a_bar() {
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && !is_set("NO_COLOR") && !is_set("CI") && terminal &&
         std::string_view(terminal) != "dumb";
}

Progress::Progress(bool quiet) : wanted_(!quiet && terminal_wants_a_bar()) {}

Progress::~Progress() { clear(); }

void Progress::begin(std::string_view stage, double done) {
  const double now = watch_.seconds();
  if (!times_.empty()) times_.back().seconds = now - stage_start_;
  times_.push_back({std::string(stage), 0});
  stage_start_ = now;
  if (wanted_ && now > kPatience) draw(stage, done);
}

std::vector<StageTime> Progress::finish() {
  if (!times_.empty()) times_.back().seconds = watch_.seconds() - stage_start_;
  clear();
  return std::exchange(times_, {});
}

void Progress::draw(std::string_view stage, double done) {
  const int filled = std::clamp(static_cast<int>(done * kWidth), 0, kWidth);
  std::string bar(static_cast<std::size_t>(filled), '=');
  bar.resize(kWidth, ' ');
  std::fprintf(stderr, "\r[%s] %3d %% %.*s\x1b[K", bar.c_str(),
               std::clamp(static_cast<int>(done * 100), 0, 100), static_cast<int>(stage.size()),
               stage.data());
  drawn_ = true;
}

void Progress::clear() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
  drawn_ = false;
}

}  // namespace marrow
