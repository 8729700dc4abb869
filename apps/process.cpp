#include "process.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

namespace marrow {

namespace {

extern "C" void end_by_signal(int signal) {
  remove_temporaries();
  ::_exit(signal == SIGPIPE ? static_cast<int>(ErrorKind::CannotWrite) : 128 + signal);
}

/// The wrong way round, so that using one of them still fails.
void open_standard_files() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(fd, F_GETFD) < 0) ::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

void prepare_process() {
  open_standard_files();
  struct sigaction action {};
  action.sa_handler = end_by_signal;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    // A parent that ignores a signal (nohup) wants it ignored here too; except for SIGPIPE, which
    // some languages ignore in all that they start.
    if (signal == SIGPIPE || before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace marrow
