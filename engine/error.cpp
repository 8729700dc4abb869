#include <marrow/error.hpp>

namespace marrow {

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(message), kind_(kind) {}

}  // namespace marrow
