#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

namespace marrow {

namespace {

std::string reason(int error) { return std::strerror(error); }

[[noreturn]] void cannot_read(const std::string& name, const std::string& why) {
  throw Error(ErrorKind::CannotRead, name + ": cannot be read: " + why);
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::CannotWrite, path + ": cannot be written: " + why);
}

[[noreturn]] void too_large(const std::string& name, std::uint64_t max_bytes) {
  throw Error(ErrorKind::Limit, name + ": is larger than the limit of " +
                                    std::to_string(max_bytes) +
                                    " bytes; raise the limit or simplify the file");
}

/// An open file that closes itself. close() tells whether the bytes have arrived: some file
/// systems say so only there.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
  }

  int get() const { return fd_; }
  bool is_open() const { return fd_ >= 0; }
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// Appends what is left in `fd` to `bytes`; `expected` is its size as far as it is known.
void read_all(int fd, const std::string& name, std::uint64_t expected, std::uint64_t max_bytes,
              std::string& bytes) {
  constexpr std::uint64_t kFirstPiece = 1 << 16;
  // One byte more than expected, so that the end is seen without growing.
  std::uint64_t room = std::max(kFirstPiece, expected + 1);
  std::uint64_t size = 0;
  for (;;) {
    if (size == bytes.size()) {
      bytes.resize(std::min(size + room, max_bytes + 1));
      room = bytes.size();
    }
    const ssize_t got = ::read(fd, bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) cannot_read(name, reason(errno));
    if (got == 0) break;
    size += static_cast<std::uint64_t>(got);
    if (size > max_bytes) too_large(name, max_bytes);
  }
  bytes.resize(size);
}

/// 0, or the reason why not all has been written.
int write_all(int fd, std::string_view bytes) {
  constexpr std::size_t kLargestPiece = std::size_t{1} << 30;
  while (!bytes.empty()) {
    const ssize_t put = ::write(fd, bytes.data(), std::min(bytes.size(), kLargestPiece));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return 0;
}

using Pieces = std::function<std::string_view()>;

int write_all(int fd, const Pieces& next) {
  for (std::string_view piece = next(); !piece.empty(); piece = next())
    if (const int error = write_all(fd, piece)) return error;
  return 0;
}

void write_in_place(const std::string& path, const Pieces& next) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) cannot_write(path, reason(errno));
  if (const int error = write_all(file.get(), next)) cannot_write(path, reason(error));
  if (!file.close()) cannot_write(path, reason(errno));
}

/// The folder of `path` with its last slash; empty for the current folder.
std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

/// The end of a chain of links; it need not exist.
struct Destination {
  std::string path;
  bool is_open_file = false;  ///< links in /proc stand for open files: no names to rename to
};

Destination follow_links(const std::string& path) {
  constexpr int kMaxLinks = 40;
  Destination at{path};
  for (int i = 0; i < kMaxLinks; ++i) {
    at.is_open_file = at.path.starts_with("/proc/");
    if (at.is_open_file) return at;
    char target[4096];
    const ssize_t size = ::readlink(at.path.c_str(), target, sizeof target);
    if (size < 0) return at;
    const std::string next(target, static_cast<std::size_t>(size));
    at.path = next.starts_with('/') ? next : folder_of(at.path) + next;
  }
  cannot_write(path, reason(ELOOP));
}

/// Names of temporary files where a signal handler can read them: no locks, no heap. More writers
/// than slots, or a longer name, and a file stays behind if a signal ends the program right then.
class TemporaryNames {
 public:
  TemporaryNames() = default;

  /// The slot that keeps `path`; none if all are taken.
  int keep(const std::string& path) noexcept {
    for (int i = 0; i < kSlots && path.size() < kLongest; ++i) {
      State expected = State::Free;
      Slot& slot = slots_[static_cast<std::size_t>(i)];
      if (!slot.state.compare_exchange_strong(expected, State::Filling)) continue;
      std::memcpy(slot.path, path.c_str(), path.size() + 1);
      slot.state = State::Kept;
      return i;
    }
    return -1;
  }
  void forget(int slot) noexcept {
    if (slot >= 0) slots_[static_cast<std::size_t>(slot)].state = State::Free;
  }
  void remove_all() noexcept {
    for (Slot& slot : slots_)
      if (slot.state == State::Kept) ::unlink(slot.path);
  }

 private:
  static constexpr int kSlots = 8;
  static constexpr std::size_t kLongest = 4096;
  enum class State { Free, Filling, Kept };
  struct Slot {
    std::atomic<State> state{State::Free};
    char path[kLongest] = {};
  };
  static_assert(std::atomic<State>::is_always_lock_free);

  std::array<Slot, kSlots> slots_;
};

TemporaryNames temporary_names;

/// A new file beside the target, removed again unless it has been renamed to it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target) : target_(target) {
    static std::atomic<unsigned> counter{0};
    constexpr int kMaxTries = 100;
    for (int i = 0; i < kMaxTries && fd_ < 0; ++i) {
      path_ = folder_of(target) + ".marrow-" + std::to_string(::getpid()) + "-" +
              std::to_string(counter++) + ".tmp";
      slot_ = temporary_names.keep(path_);
      fd_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      error_ = fd_ < 0 ? errno : 0;
      if (fd_ < 0) temporary_names.forget(std::exchange(slot_, -1));
      if (error_ != EEXIST) break;
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (fd_ >= 0) ::close(fd_);
    if (!path_.empty() && error_ == 0 && !renamed_) ::unlink(path_.c_str());
    temporary_names.forget(slot_);
  }

  void write(const Pieces& next) {
    fail_if(error_);
    fail_if(write_all(fd_, next));
  }
  void copy_permissions_of(const struct stat& existing) {
    if (error_ == 0 && ::fchmod(fd_, existing.st_mode & 07777) != 0) fail_if(errno);
  }
  void rename_to_target() {
    if (::close(std::exchange(fd_, -1)) != 0) fail_if(errno);
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail_if(errno);
    renamed_ = true;
  }

 private:
  void fail_if(int error) const {
    if (error != 0) cannot_write(target_, reason(error));
  }

  std::string target_, path_;
  int fd_ = -1;
  int error_ = 0;
  int slot_ = -1;
  bool renamed_ = false;
};

void replace_file(const std::string& target, const struct stat* existing, const Pieces& next) {
  // Renaming would replace a file that says "read only" without asking.
  if (existing && ::access(target.c_str(), W_OK) != 0) cannot_write(target, reason(errno));
  TemporaryFile file(target);
  if (existing) file.copy_permissions_of(*existing);
  file.write(next);
  file.rename_to_target();
}

}  // namespace

std::string read_file(const std::string& path, std::uint64_t max_bytes) {
  const bool standard_input = path == "-";
  const std::string name = standard_input ? "standard input" : path;
  Descriptor file(standard_input ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) cannot_read(name, reason(errno));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) cannot_read(name, reason(errno));
  if (S_ISDIR(status.st_mode)) cannot_read(name, "it is a folder");
  max_bytes = std::min(max_bytes, std::uint64_t{1} << 62);
  const auto size = S_ISREG(status.st_mode) ? static_cast<std::uint64_t>(status.st_size) : 0;
  if (size > max_bytes) too_large(name, max_bytes);
  std::string bytes;
  try {
    read_all(file.get(), name, size, max_bytes, bytes);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::Limit, name + ": is larger than the memory; simplify the file");
  } catch (const std::length_error&) {
    throw Error(ErrorKind::Limit, name + ": is larger than the memory; simplify the file");
  }
  return bytes;
}

void write_file(const std::string& path, std::string_view bytes) {
  write_file(path, [&] { return std::exchange(bytes, {}); });
}

void write_file(const std::string& path, const Pieces& next) {
  // Opening /dev/stdout again would write from the start of a file that others append to.
  if (path == "-" || path == "/dev/stdout") {
    if (const int error = write_all(STDOUT_FILENO, next))
      cannot_write("standard output", reason(error));
    return;
  }
  if (path.empty()) cannot_write("''", "the name is empty");
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) cannot_write(path, "it is a folder");
  if (exists && !S_ISREG(status.st_mode)) return write_in_place(path, next);
  const Destination destination = follow_links(path);
  if (destination.is_open_file) return write_in_place(path, next);
  replace_file(destination.path, exists ? &status : nullptr, next);
}

void remove_temporaries() noexcept { temporary_names.remove_all(); }

std::string extension_of(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return "";
  std::string extension = name.substr(dot + 1);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace marrow
