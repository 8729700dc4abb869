#include "batch_folder.hpp"

#include <marrow/error.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

namespace marrow {

namespace {

namespace fs = std::filesystem;

constexpr const char* kWork = ".work-";

std::string suffix_of(const Shard& shard) {
  return std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::CannotWrite, path + ": cannot be written: " + why);
}

void make_folders(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) cannot_write(path, error.message());
}

int open_lock(const std::string& folder, int flags) {
  return ::open((folder + "/lock").c_str(), O_RDWR | O_CLOEXEC | flags, 0666);
}

/// Whether another process has the lock. Where a file system has no locks, nobody is kept out.
bool is_held_elsewhere(int lock) {
  return ::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// The workers of a run that was killed hold its lock until they are gone too, soon after.
bool take(int lock) {
  constexpr int kTries = 20;
  for (int i = 0; i < kTries && is_held_elsewhere(lock); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return !is_held_elsewhere(lock);
}

/// Folders of runs with another number of shards that nobody holds; those of this number belong to
/// tasks that may be starting now.
void remove_stale(const std::string& folder, const Shard& shard) {
  const std::string same_count = "-of-" + std::to_string(shard.count);
  std::vector<std::string> stale;
  std::error_code ignored;
  for (fs::directory_iterator at(folder, ignored), end; !ignored && at != end;
       at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(kWork) && !name.ends_with(same_count))
      stale.push_back(at->path().string());
  }
  for (const std::string& path : stale) {
    const int lock = open_lock(path, 0);
    if (lock < 0) continue;
    if (!is_held_elsewhere(lock)) fs::remove_all(path, ignored);
    ::close(lock);
  }
}

void empty_but_for_lock(const std::string& path) {
  std::error_code ignored;
  for (fs::directory_iterator at(path, ignored), end; !ignored && at != end; at.increment(ignored))
    if (at->path().filename() != "lock") fs::remove_all(at->path(), ignored);
}

}  // namespace

std::string results_path(const std::string& folder, const Shard& shard) {
  return folder + "/results-" + suffix_of(shard) + ".jsonl";
}

std::vector<std::string> results_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  fs::directory_iterator at(folder, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with("results-") && name.ends_with(".jsonl"))
      paths.push_back(at->path().string());
  }
  if (error) throw Error(ErrorKind::CannotRead, folder + ": cannot be read: " + error.message());
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool is_of_another_shard(const std::string& results, const std::string& folder,
                         const Shard& shard) {
  const std::string same_count = "-of-" + std::to_string(shard.count) + ".jsonl";
  return results.ends_with(same_count) && results != results_path(folder, shard);
}

std::string output_path(const std::string& folder, const std::string& kind, const std::string& id) {
  if (kind == kPicture) return folder + "/pictures/" + id + ".png";
  if (kind.starts_with(kMap)) return folder + "/maps/" + id + kind.substr(kind.find('.'));
  return folder + "/skeletons/" + id + "." + (kind == "polylines" ? "polylines.txt" : kind);
}

WorkFolder::WorkFolder(const std::string& folder, const Shard& shard)
    : path_(folder + "/" + kWork + suffix_of(shard)) {
  make_folders(path_);
  lock_ = open_lock(path_, O_CREAT);
  if (lock_ < 0) cannot_write(path_ + "/lock", std::strerror(errno));
  if (!take(lock_)) {
    ::close(lock_);
    throw Error(ErrorKind::Usage, folder +
                                      ": this shard is being run by another process; wait for "
                                      "it, or name another folder");
  }
  empty_but_for_lock(path_);
  remove_stale(folder, shard);
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

}  // namespace marrow
