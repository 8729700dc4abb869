// Whole files in, whole files out.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace marrow {

/// The bytes of `path`; "-" is standard input. Reads at most `max_bytes`.
/// Throws Error: CannotRead (no such file, a folder, no permission), Limit (larger than `max_bytes`
/// or than memory).
std::string read_file(const std::string& path, std::uint64_t max_bytes = std::uint64_t{4} << 30);

/// Writes `bytes` to a temporary name beside `path` and renames it, so that `path` is either whole
/// or untouched. A link is followed, and the file that it leads to replaced; an existing file keeps
/// its permissions. Devices and pipes (/dev/stdout, /dev/null) are written to in place; "-" is
/// standard output. Throws Error: CannotWrite, and leaves nothing behind.
void write_file(const std::string& path, std::string_view bytes);

/// The same for bytes that come in pieces: `next` is called until it gives an empty one. A piece
/// must last until the next call.
void write_file(const std::string& path, const std::function<std::string_view()>& next);

/// Removes the temporary files of every write_file() under way in this process. For programs that
/// are told to end: safe in a signal handler, and only sensible right before _exit().
void remove_temporaries() noexcept;

/// The extension of `path` in lower case without its dot: "a/B.OBJ" -> "obj"; empty if there is
/// none, also for hidden files such as ".obj".
std::string extension_of(const std::string& path);

}  // namespace marrow
