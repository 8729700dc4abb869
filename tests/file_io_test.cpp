#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "catch.hpp"

using namespace marrow;
namespace fs = std::filesystem;

namespace {

/// An empty folder that goes away with all that is in it.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "marrow-file-io-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::ptrdiff_t file_count() const {
    return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
  }

 private:
  std::string path_;
};

template <class Call>
ErrorKind kind_of(Call&& call) {
  try {
    call();
  } catch (const Error& e) {
    CHECK(std::string(e.what()).find('\n') == std::string::npos);
    return e.kind();
  }
  FAIL("no error");
  return ErrorKind::Internal;
}

/// Files larger than `bytes` cannot be written while this lives: a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit now{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace

TEST_CASE("bytes come back as they were written", "[file_io]") {
  const Folder folder;
  std::string bytes("a\0b\r\n\xff", 6);
  for (const std::size_t size : {std::size_t{0}, std::size_t{6}, std::size_t{1} << 17}) {
    bytes.resize(size, 'x');
    write_file(folder / "f", bytes);
    CHECK(read_file(folder / "f") == bytes);
  }
  CHECK(folder.file_count() == 1);
}

TEST_CASE("reading tells why it cannot", "[file_io]") {
  const Folder folder;
  CHECK(kind_of([&] { read_file(folder / "nothing"); }) == ErrorKind::CannotRead);
  CHECK(kind_of([&] { read_file(folder / "."); }) == ErrorKind::CannotRead);
  CHECK(kind_of([&] { read_file(""); }) == ErrorKind::CannotRead);
}

TEST_CASE("a file of exactly the limit is read, one byte more is not", "[file_io]") {
  const Folder folder;
  write_file(folder / "f", "12345678");
  CHECK(read_file(folder / "f", 8).size() == 8);
  CHECK(kind_of([&] { read_file(folder / "f", 7); }) == ErrorKind::Limit);
  // The size of a device is not known before it is read.
  CHECK(kind_of([&] { read_file("/dev/zero", 100'000); }) == ErrorKind::Limit);
  CHECK(read_file("/dev/null").empty());
}

TEST_CASE("a file in the current folder needs no slash", "[file_io]") {
  const Folder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder / ".");
  write_file("plain", "x");
  const std::string bytes = read_file("plain");
  fs::current_path(before);
  CHECK(bytes == "x");
}

TEST_CASE("a failed write leaves what was there, and nothing else", "[file_io]") {
  const Folder folder;
  write_file(folder / "f", "before");
  const std::string large(100'000, 'x');
  {
    const FullDisk full(5000);
    CHECK(kind_of([&] { write_file(folder / "f", large); }) == ErrorKind::CannotWrite);
    CHECK(kind_of([&] { write_file(folder / "new", large); }) == ErrorKind::CannotWrite);
  }
  CHECK(read_file(folder / "f") == "before");
  CHECK(folder.file_count() == 1);
  CHECK(kind_of([&] { write_file(folder / ".", "x"); }) == ErrorKind::CannotWrite);
  CHECK(kind_of([&] { write_file(folder / "no/such/folder", "x"); }) == ErrorKind::CannotWrite);
  CHECK(kind_of([&] { write_file("", "x"); }) == ErrorKind::CannotWrite);
}

TEST_CASE("an existing file keeps its permissions", "[file_io]") {
  const Folder folder;
  write_file(folder / "f", "x");
  ::chmod((folder / "f").c_str(), 0640);
  write_file(folder / "f", "y");
  struct stat status {};
  REQUIRE(::stat((folder / "f").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("links are followed, not replaced", "[file_io]") {
  const Folder folder;
  fs::create_directory(folder / "d");
  fs::create_symlink("d/target", folder / "link");
  write_file(folder / "link", "through a link to nothing");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(read_file(folder / "d/target") == "through a link to nothing");
  write_file(folder / "link", "again");
  CHECK(read_file(folder / "d/target") == "again");

  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  CHECK(kind_of([&] { write_file(folder / "a", "x"); }) == ErrorKind::CannotWrite);
}

TEST_CASE("devices are written to, not replaced", "[file_io]") {
  write_file("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) {
    CHECK(kind_of([] { write_file("/dev/full", "x"); }) == ErrorKind::CannotWrite);
    CHECK(fs::is_character_file("/dev/full"));
  }
}

TEST_CASE("a name of an open file is written in place", "[file_io]") {
  const Folder folder;
  write_file(folder / "f", "before and longer");
  const int fd = ::open((folder / "f").c_str(), O_RDONLY);
  REQUIRE(fd >= 0);
  struct stat before {
  }, after{};
  ::fstat(fd, &before);
  write_file("/proc/self/fd/" + std::to_string(fd), "after");
  ::close(fd);
  ::stat((folder / "f").c_str(), &after);
  CHECK(before.st_ino == after.st_ino);
  CHECK(read_file(folder / "f") == "after");
}

TEST_CASE("extensions are lower case and without a dot", "[file_io]") {
  CHECK(extension_of("a/B.OBJ") == "obj");
  CHECK(extension_of("x.tar.Gz") == "gz");
  CHECK(extension_of("a.d/file") == "");
  CHECK(extension_of(".obj") == "");
  CHECK(extension_of("a/.obj") == "");
  CHECK(extension_of("dot.") == "");
  CHECK(extension_of("-") == "");
}

TEST_CASE("a signal in the middle of writing leaves no temporary file", "[file_io]") {
  const Folder folder;
  const std::string target = folder / "large";
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGTERM, [](int) {
      remove_temporaries();
      ::_exit(3);
    });
    const std::string bytes(std::size_t{1} << 24, 'x');
    for (;;) write_file(target, bytes);
  }
  REQUIRE(child > 0);
  while (folder.file_count() == 0) ::usleep(100);
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 3);
  CHECK(folder.file_count() == (fs::exists(target) ? 1 : 0));
}
