// The one exception of the library.
#pragma once

#include <stdexcept>
#include <string>

namespace marrow {

/// What went wrong; the value is the exit status of the program.
enum class ErrorKind {
  Internal = 1,
  Usage = 2,
  CannotRead = 3,   ///< the file is not there or cannot be opened
  Malformed = 4,    ///< the file's bytes are not what its format says
  Unsupported = 5,  ///< a format, or a part of it, that we do not read
  Empty = 6,        ///< a legal shape with nothing to skeletonise
  Limit = 7,        ///< a limit on size, memory or time was hit
  CannotWrite = 8,
  CheckFailed = 10,  ///< of `marrow check`: a figure is not what was asked for
};

/// "internal", "usage", "cannot-read" and so on.
const char* name_of(ErrorKind kind);

/// Every failure that a caller can cause is thrown as this type. `what()` is one line that names
/// the file, the place in it and the mend: "horse.obj:12: vertex index 99 is out of range 1..8;
/// ...".
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message);

  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace marrow
