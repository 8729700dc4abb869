#include "process.hpp"

#include <marrow/error.hpp>
#include <marrow/file_io.hpp>

#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>

namespace marrow {

namespace {

extern "C" void end_by_signal(int signal) {
  remove_temporaries();
  ::_exit(signal == SIGPIPE ? static_cast<int>(ErrorKind::CannotWrite) : 128 + signal);
}

// Where the handler of a signal can read them.
char last_words[4096];
std::size_t last_words_size = 0;

extern "C" void end_by_clock(int) {
  remove_temporaries();
  const ssize_t ignored = ::write(STDERR_FILENO, last_words, last_words_size);
  static_cast<void>(ignored);
  ::_exit(static_cast<int>(ErrorKind::Limit));
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
  // A file that grows beyond what is allowed is one that cannot be written.
  std::signal(SIGXFSZ, SIG_IGN);
}

void end_after(int seconds, const std::string& words) {
  // A bar of progress may stand there.
  const std::string text = (::isatty(STDERR_FILENO) == 1 ? "\n" : "") + words;
  last_words_size = std::min(text.size(), sizeof last_words - 1);
  std::memcpy(last_words, text.data(), last_words_size);
  last_words[last_words_size++] = '\n';
  struct sigaction action {};
  action.sa_handler = end_by_clock;
  sigfillset(&action.sa_mask);
  ::sigaction(SIGALRM, &action, nullptr);
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  ::sigprocmask(SIG_UNBLOCK, &alarm, nullptr);
  const itimerval time{{0, 0}, {seconds, 0}};
  ::setitimer(ITIMER_REAL, &time, nullptr);
}

}  // namespace marrow
