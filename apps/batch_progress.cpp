#include "batch_progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace marrow {

namespace {

std::string with_decimals(double value, int decimals) {
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, value);
  return digits;
}

std::string span_of(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace

BatchProgress::BatchProgress(std::size_t total, bool quiet)
    : total_(total), quiet_(quiet), on_terminal_(!quiet && terminal_wants_a_bar()) {}

void BatchProgress::skip(bool is_done) { ++(is_done ? done_before_ : failed_before_); }

void BatchProgress::add(const std::string& status) {
  ++ended_;
  if (status == "done") return;
  ++failures_;
  ++causes_[status];
}

void BatchProgress::show() {
  constexpr double kRedraw = 0.2, kNextLine = 30;
  const double now = watch_.seconds();
  if (quiet_ || now - shown_ < (on_terminal_ ? kRedraw : kNextLine)) return;
  shown_ = now;
  if (on_terminal_)
    std::fprintf(stderr, "\r%s\x1b[K", line().c_str());
  else
    std::fprintf(stderr, "marrow: %s\n", line().c_str());
}

void BatchProgress::finish(const std::string& where) {
  if (on_terminal_) std::fputs("\r\x1b[K", stderr);
  if (quiet_) return;
  std::string causes;
  for (const auto& [cause, count] : causes_)
    causes += (causes.empty() ? " (" : ", ") + cause + " " + std::to_string(count);
  if (!causes.empty()) causes += ")";
  std::string before;
  if (done_before_ + failed_before_ > 0)
    before = "; before: done " + std::to_string(done_before_) + ", failed " +
             std::to_string(failed_before_);
  const double seconds = watch_.seconds();
  std::fprintf(stderr, "%s: done %zu, failed %zu%s%s; %.2f s, %.2f shapes/s\n", where.c_str(),
               ended_ - failures_, failures_, causes.c_str(), before.c_str(), seconds,
               static_cast<double>(ended_) / std::max(seconds, 1e-9));
}

std::string BatchProgress::line() const {
  const std::size_t past = done_before_ + failed_before_ + ended_;
  const double rate = static_cast<double>(ended_) / watch_.seconds();
  std::string text = std::to_string(past) + "/" + std::to_string(total_) + " shapes, " +
                     with_decimals(rate, rate < 10 ? 2 : 0) + "/s, failures " +
                     std::to_string(failures_);
  if (ended_ > 0) text += ", " + span_of(static_cast<double>(total_ - past) / rate) + " left";
  return text;
}

}  // namespace marrow
