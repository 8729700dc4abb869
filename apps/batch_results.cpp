#include "batch_results.hpp"

#include <marrow/error.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <unordered_map>

#include "batch_folder.hpp"
#include "hash.hpp"

namespace marrow {

namespace {

/// The size of the file up to and with its last end of line.
std::uint64_t whole_lines(int fd, std::uint64_t size) {
  char piece[4096];
  while (size > 0) {
    const std::uint64_t begin = size - std::min<std::uint64_t>(size, sizeof piece);
    const ssize_t got = ::pread(fd, piece, size - begin, static_cast<off_t>(begin));
    if (got <= 0) return size;
    const std::string_view text(piece, static_cast<std::size_t>(got));
    const std::size_t end = text.rfind('\n');
    if (end != std::string_view::npos) return begin + end + 1;
    size = begin;
  }
  return 0;
}

double number_in_run(const Statistics& row, const char* key, double otherwise) {
  const auto run = row.find("run");
  if (run == row.end() || !run->is_object()) return otherwise;
  const auto at = run->find(key);
  return at != run->end() && at->is_number() ? at->get<double>() : otherwise;
}

Prior prior_of(const Statistics& row, const RowPlace& place) {
  Prior prior;
  prior.ended = place.ended;
  prior.attempt =
      static_cast<std::uint64_t>(std::clamp(number_in_run(row, "attempt", 1), 1.0, 1e9));
  const std::string status = text_at(row, "status");
  prior.is_done = status == "done";
  prior.is_to_repeat = status == "cannot-write" || status == kKilled;
  prior.setting = setting_of(row);
  if (const auto input = row.find("input"); input != row.end())
    prior.hash = text_at(*input, "hash");
  if (const auto outputs = row.find("outputs"); outputs != row.end())
    for (const auto& [kind, size] : outputs->items())
      prior.output_sizes.push_back(size.is_number_unsigned() ? size.get<std::uint64_t>() : 0);
  return prior;
}

}  // namespace

std::uint64_t for_each_row(const std::string& path,
                           const std::function<void(const Statistics&, const RowPlace&)>& take) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(ErrorKind::CannotRead, path + ": cannot be read: " + std::strerror(errno));
  std::uint64_t torn = 0;
  RowPlace place;
  for (std::string line; std::getline(in, line); place.offset += line.size() + 1) {
    place.size = line.size();
    const Statistics row = Statistics::parse(line, nullptr, false);
    const bool is_whole =
        !in.eof() && row.is_object() && row.contains("id") && row["id"].is_string();
    if (is_whole) {
      place.ended = std::max(place.ended, number_in_run(row, "ended", 0));
      take(row, place);
    } else {
      ++torn;
    }
  }
  return torn;
}

std::string text_at(const Statistics& object, const std::string& key) {
  if (!object.is_object()) return "";
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

ResultLog::ResultLog(const std::string& path) : path_(path) {
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(errno);
  const off_t size = ::lseek(fd_, 0, SEEK_END);
  if (size < 0) fail(errno);
  size_ = whole_lines(fd_, static_cast<std::uint64_t>(size));
  if (size_ < static_cast<std::uint64_t>(size) && ::ftruncate(fd_, static_cast<off_t>(size_)) != 0)
    fail(errno);
}

ResultLog::~ResultLog() { ::close(fd_); }

void ResultLog::append(const Statistics& row) {
  const std::string line = row.dump(-1, ' ', false, Statistics::error_handler_t::replace) + "\n";
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t put = ::write(fd_, rest.data(), rest.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      const int error = errno;
      // Where not even this works, the next run finds a torn line and cuts it off.
      if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0) fail(error);
      fail(error);
    }
    rest.remove_prefix(static_cast<std::size_t>(put));
  }
  size_ += line.size();
}

void ResultLog::sync() {
  if (::fdatasync(fd_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
}

void ResultLog::fail(int error) const {
  throw Error(ErrorKind::CannotWrite, path_ + ": cannot be written: " + std::strerror(error));
}

std::uint64_t setting_of(const Statistics& row) {
  std::uint64_t hash = kFirstHash;
  for (const char* key : {"options", "version"})
    if (const auto at = row.find(key); at != row.end()) hash = hash_on(hash, at->dump());
  return hash;
}

std::vector<Prior> priors_of(const std::vector<BatchItem>& items, const std::string& folder,
                             const Shard& shard, std::uint64_t& torn) {
  std::vector<Prior> priors(items.size());
  std::unordered_map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < items.size(); ++i) places.emplace(items[i].id, i);
  for (const std::string& path : results_in(folder)) {
    if (is_of_another_shard(path, folder, shard)) continue;
    torn += for_each_row(path, [&](const Statistics& row, const RowPlace& place) {
      const auto at = places.find(row["id"].get_ref<const std::string&>());
      if (at == places.end()) return;
      if (place.ended >= priors[at->second].ended) priors[at->second] = prior_of(row, place);
    });
  }
  return priors;
}

}  // namespace marrow
