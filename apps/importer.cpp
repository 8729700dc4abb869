#include "importer.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "limits.hpp"

namespace marrow {

namespace {

constexpr const char* kConvert = "; convert it to PLY or OBJ";

[[noreturn]] void fail(ErrorKind kind, const InputFile& file, const std::string& words) {
  throw Error(kind, file.name + ": " + words);
}

/// A file in memory without a name. No pipe: the other end of one may die before it has read all.
class MemoryFile {
 public:
  explicit MemoryFile(const char* label) : fd_(::memfd_create(label, MFD_CLOEXEC)) {
    if (fd_ < 0)
      throw Error(ErrorKind::Limit, std::string("no file in memory: ") + std::strerror(errno));
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(fd_); }

  int get() const { return fd_; }
  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

std::string program_path() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "marrow-import";
}

/// Runs the program with the three files as its standard ones; what waitpid() says of its end.
int run_program(const std::string& program, const std::vector<std::string>& words,
                const std::array<const MemoryFile*, 3>& files) {
  std::vector<char*> argv;
  std::vector<std::string> copies = words;
  copies.insert(copies.begin(), program);
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (int i = 0; i < 3; ++i)
    ::posix_spawn_file_actions_adddup2(&actions, files[static_cast<std::size_t>(i)]->get(), i);
  std::signal(SIGCHLD, SIG_DFL);  // where it is ignored, children end without a status
  pid_t child = 0;
  const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw Error(ErrorKind::Limit, program + ": cannot be started: " + std::strerror(error));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Its exit statuses are ours; its words come without the name of the file.
[[noreturn]] void explain(const InputFile& file, int status, const std::string& words) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    fail(ErrorKind::Limit, file,
         std::string("takes the importer more time or memory than there is for a file") + kConvert);
  const auto kind = WIFEXITED(status) ? static_cast<ErrorKind>(WEXITSTATUS(status)) : ErrorKind{};
  const bool is_expected = kind == ErrorKind::Malformed || kind == ErrorKind::Unsupported ||
                           kind == ErrorKind::Empty || kind == ErrorKind::Limit;
  if (!is_expected || words.empty())
    fail(ErrorKind::Malformed, file,
         std::string("cannot be read: the importer crashed") + kConvert);
  throw_with_option(Error(kind, file.name + ": " + words.substr(0, words.find('\n'))),
                    "--max-faces");
}

}  // namespace

const std::vector<std::string>& imported_formats() {
  static const std::vector<std::string> formats{"gltf", "glb", "fbx", "dae", "3ds", "x3d", "3mf"};
  return formats;
}

bool is_imported(const InputFile& file) {
  const auto& formats = imported_formats();
  return std::find(formats.begin(), formats.end(), file.format) != formats.end();
}

Shape imported_shape(const InputFile& file) {
  const std::string program = program_path();
  if (::access(program.c_str(), X_OK) != 0)
    fail(ErrorKind::Unsupported, file,
         "is read by marrow-import, which is not beside marrow; build Marrow where Assimp is "
         "installed (Debian: libassimp-dev), or convert the file to PLY or OBJ");
  if (file.bytes.empty()) fail(ErrorKind::Empty, file, "is empty (0 bytes)");
  const MemoryFile in("marrow-in"), out("marrow-out"), words("marrow-words");
  write_file(in.path(), file.bytes);
  const int status = run_program(program, {file.format, std::to_string(file.limits.max_triangles)},
                                 {&in, &out, &words});
  if (status != 0) explain(file, status, read_file(words.path()));
  return parse_shape(read_file(out.path()), ShapeFormat::Ply, file.name, file.limits);
}

}  // namespace marrow
