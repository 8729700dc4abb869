#include <marrow/error.hpp>

namespace marrow {

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Internal:
      return "internal";
    case ErrorKind::Usage:
      return "usage";
    case ErrorKind::CannotRead:
      return "cannot-read";
    case ErrorKind::Malformed:
      return "malformed";
    case ErrorKind::Unsupported:
      return "unsupported";
    case ErrorKind::Empty:
      return "empty";
    case ErrorKind::Limit:
      return "limit";
    case ErrorKind::CannotWrite:
      return "cannot-write";
    case ErrorKind::CheckFailed:
      return "check-failed";
  }
  return "internal";
}

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(message), kind_(kind) {}

}  // namespace marrow
